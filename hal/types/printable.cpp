#include "hal/types/printable.h"

#include <fmt/core.h>

#include <cstddef>

namespace hal {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool is_within(unsigned byte, unsigned low, unsigned high) { return byte >= low && byte <= high; }

/// Bytes of the well-formed character that the text begins with; 0: none. The Unicode Standard
/// 15.0, table 3-7.
std::size_t character_size(std::string_view text) {
  const unsigned first = byte_at(text, 0), second = byte_at(text, 1);
  const auto continues = [&](std::size_t i) { return is_within(byte_at(text, i), 0x80, 0xBF); };
  if (first < 0x80) return 1;
  if (is_within(first, 0xC2, 0xDF)) return continues(1) ? 2 : 0;
  if (is_within(first, 0xE0, 0xEF)) {
    const unsigned low = first == 0xE0 ? 0xA0 : 0x80, high = first == 0xED ? 0x9F : 0xBF;
    return is_within(second, low, high) && continues(2) ? 3 : 0;
  }
  if (is_within(first, 0xF0, 0xF4)) {
    const unsigned low = first == 0xF0 ? 0x90 : 0x80, high = first == 0xF4 ? 0x8F : 0xBF;
    return is_within(second, low, high) && continues(2) && continues(3) ? 4 : 0;
  }
  return 0;
}

/// Of well-formed UTF-8. C1 is U+0080 to U+009F.
bool is_control(std::string_view character) {
  const unsigned first = byte_at(character, 0);
  if (character.size() == 2) return first == 0xC2 && byte_at(character, 1) < 0xA0;
  return character.size() == 1 && ((first < 0x20 && first != '\t') || first == 0x7F);
}

std::string escaped(std::string_view bytes) {
  if (bytes == "\n") return "\\n";
  std::string text;
  for (const char byte : bytes) text += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
  return text;
}

std::string shown(std::string_view text, bool in_lines) {
  std::string result;
  while (!text.empty()) {
    const std::size_t size = character_size(text);
    const std::string_view next = text.substr(0, size == 0 ? 1 : size);
    text.remove_prefix(next.size());
    const bool stays = size > 0 && (!is_control(next) || (in_lines && next == "\n"));
    result += stays ? std::string(next) : escaped(next);
  }
  return result;
}

}  // namespace

std::string printable(std::string_view text) { return shown(text, false); }
std::string printable_lines(std::string_view text) { return shown(text, true); }

}  // namespace hal
