#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace hal {

/// What a line tells people, which decides its colours on a terminal.
enum class Tone {
  kMistake,   ///< The place bold, the word after it red.
  kWarning,   ///< The place bold, the word after it yellow.
  kResult,    ///< Bold.
  kProgress,  ///< Faint.
};

/// Whether colours may be written to a stream: it is a terminal, TERM is not "dumb", and NO_COLOR
/// is unset or empty (https://no-color.org). Each stream is judged for itself.
bool shows_colours(std::FILE* stream);

/// The text with its colours, as escape sequences of ECMA-48, 5th edition, 8.3.117.
///
/// Of mistakes and warnings, each line "file:2:11: tx_power: 45 dBm is …" has a place and a word.
/// If the text begins with the word ("error: …", "warning: …"), its further lines are not coloured.
/// @param text  printable (hal/types/printable.h), without a line feed at its end.
std::string coloured(Tone tone, std::string_view text);

/// The same if shows_colours(stream), else the text as it is.
std::string coloured_for(std::FILE* stream, Tone tone, std::string_view text);

/// Writes the text and a line feed to standard error, coloured_for() it. Throws nothing if that
/// cannot be written.
void print_line(Tone tone, std::string_view text);

}  // namespace hal
