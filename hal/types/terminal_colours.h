#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace hal {

/// Kind of a line of output; decides its colours on a terminal.
enum class Tone {
  kMistake,   ///< An error: the place bold, the word after it red.
  kWarning,   ///< A warning: the place bold, the word after it yellow.
  kResult,    ///< A result: bold.
  kProgress,  ///< Progress: faint.
};

/// Whether colours may be written to a stream: it is a terminal, TERM is not "dumb", and NO_COLOR
/// is unset or empty (https://no-color.org). Standard output and standard error may differ.
bool shows_colours(std::FILE* stream);

/// The text with its colours, as escape sequences of ECMA-48, 5th edition, 8.3.117.
///
/// In mistakes and warnings each line "file:2:11: tx_power: 45 dBm is …" has a place and a word. If
/// the text begins with the word ("error: …", "warning: …"), the lines after the first are not
/// coloured.
/// @param text  printable (hal/types/printable.h), without a line feed at its end.
std::string coloured(Tone tone, std::string_view text);

/// coloured() if shows_colours(stream), else the unchanged text.
std::string coloured_for(std::FILE* stream, Tone tone, std::string_view text);

/// Writes the text, coloured for standard error, and a line feed to standard error. Write errors
/// are ignored.
void print_line(Tone tone, std::string_view text);

}  // namespace hal
