#include "hal/types/printable.h"

#include <fmt/core.h>

#include <array>
#include <cstddef>

namespace hal {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool is_within(unsigned byte, unsigned low, unsigned high) { return byte >= low && byte <= high; }

/// Multi-byte characters: permitted ranges of the first two bytes; all others are 0x80 to 0xBF.
struct Row {
  unsigned first_low, first_high, second_low, second_high;
  std::size_t size;
};

/// The Unicode Standard 15.0, table 3-7.
constexpr std::array<Row, 8> kWellFormed{{{0xC2, 0xDF, 0x80, 0xBF, 2},
                                          {0xE0, 0xE0, 0xA0, 0xBF, 3},
                                          {0xE1, 0xEC, 0x80, 0xBF, 3},
                                          {0xED, 0xED, 0x80, 0x9F, 3},
                                          {0xEE, 0xEF, 0x80, 0xBF, 3},
                                          {0xF0, 0xF0, 0x90, 0xBF, 4},
                                          {0xF1, 0xF3, 0x80, 0xBF, 4},
                                          {0xF4, 0xF4, 0x80, 0x8F, 4}}};

bool is_of(std::string_view text, const Row& row) {
  if (!is_within(byte_at(text, 0), row.first_low, row.first_high)) return false;
  if (!is_within(byte_at(text, 1), row.second_low, row.second_high)) return false;
  for (std::size_t i = 2; i < row.size; ++i) {
    if (!is_within(byte_at(text, i), 0x80, 0xBF)) return false;
  }
  return true;
}

/// Bytes of the well-formed character that the text begins with; 0: none.
std::size_t character_size(std::string_view text) {
  if (byte_at(text, 0) < 0x80) return 1;
  for (const Row& row : kWellFormed) {
    if (is_of(text, row)) return row.size;
  }
  return 0;
}

/// Whether a well-formed UTF-8 character is a control character. C1 is U+0080 to U+009F.
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
