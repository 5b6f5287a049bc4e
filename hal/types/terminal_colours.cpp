#include "hal/types/terminal_colours.h"

#include <fmt/color.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace hal {
namespace {

constexpr std::string_view kSeparator = ": ";
constexpr std::array<std::string_view, 3> kFirstWords{"error", "warning", "not met"};

fmt::text_style style_of(Tone tone) {
  switch (tone) {
    case Tone::kMistake:
      return fmt::emphasis::bold | fmt::fg(fmt::terminal_color::red);
    case Tone::kWarning:
      return fmt::emphasis::bold | fmt::fg(fmt::terminal_color::yellow);
    case Tone::kResult:
      return fmt::emphasis::bold;
    case Tone::kProgress:
      return fmt::emphasis::faint;
  }
  return {};
}

std::string styled(const fmt::text_style& style, std::string_view text) {
  return text.empty() ? std::string{} : fmt::format(style, "{}", text);
}

bool begins_with_word(std::string_view text) {
  for (const std::string_view word : kFirstWords) {
    if (text.starts_with(word) && text.substr(word.size()).starts_with(kSeparator)) return true;
  }
  return false;
}

/// Removes the text before the first separator, and the separator's colon, from `text` and returns
/// it; empty if there is no separator.
std::string_view taken_part(std::string_view& text) {
  const std::size_t end = text.find(kSeparator);
  if (end == std::string_view::npos) return {};
  const std::string_view part = text.substr(0, end + 1);
  text.remove_prefix(part.size());
  return part;
}

/// Colours a line such as "file:2:11: tx_power: 45 dBm is …". A part with a space in it is not
/// coloured as the word.
std::string coloured_line(Tone tone, std::string_view line) {
  if (line.starts_with(' ')) return std::string(line);
  std::string result = styled(fmt::emphasis::bold, taken_part(line));
  std::string_view rest = line;
  const std::string_view word = taken_part(rest);
  if (word.empty() || word.find(' ', 1) != std::string_view::npos) {
    return result + std::string(line);
  }
  return result + " " + styled(style_of(tone), word.substr(1)) + std::string(rest);
}

std::string coloured_lines(Tone tone, std::string_view text) {
  std::string result;
  for (bool is_last = false; !is_last;) {
    const std::size_t end = text.find('\n');
    is_last = end == std::string_view::npos;
    result += coloured_line(tone, text.substr(0, end));
    if (is_last) break;
    result += '\n';
    text.remove_prefix(end + 1);
  }
  return result;
}

}  // namespace

bool shows_colours(std::FILE* stream) {
  const char* const refused = std::getenv("NO_COLOR");
  if (refused != nullptr && *refused != '\0') return false;
  const char* const terminal = std::getenv("TERM");
  if (terminal != nullptr && std::string_view(terminal) == "dumb") return false;
  return ::isatty(::fileno(stream)) != 0;
}

std::string coloured(Tone tone, std::string_view text) {
  if (tone == Tone::kResult || tone == Tone::kProgress) return styled(style_of(tone), text);
  if (!begins_with_word(text)) return coloured_lines(tone, text);
  const std::string_view word = taken_part(text);
  return styled(style_of(tone), word) + std::string(text);
}

std::string coloured_for(std::FILE* stream, Tone tone, std::string_view text) {
  return shows_colours(stream) ? coloured(tone, text) : std::string(text);
}

void print_line(Tone tone, std::string_view text) {
  const std::string line = coloured_for(stderr, tone, text) + "\n";
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace hal
