#include "view/server/json_text.h"

#include <array>
#include <charconv>
#include <cmath>

namespace view::server {
namespace {

constexpr std::string_view kReplacement = "\xEF\xBF\xBD";  // U+FFFD

/// Whether a UTF-8 character can begin with these two bytes (RFC 3629, clause 4).
bool may_follow(unsigned first, unsigned second) {
  // Excludes overlong forms, surrogates, and code points above U+10FFFF.
  if (first == 0xE0) return second >= 0xA0;
  if (first == 0xED) return second <= 0x9F;
  if (first == 0xF0) return second >= 0x90;
  return first != 0xF4 || second <= 0x8F;
}

/// Length in bytes of the UTF-8 character at the begin of the text (RFC 3629, clause 4); 0 if there
/// is no valid one.
std::size_t character_at(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first < 0xC2 || first > 0xF4) return 0;
  const std::size_t length = first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  return may_follow(first, byte(1)) ? length : 0;
}

void append_escaped(std::string& to, unsigned char c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  to += "\\u00";
  to += kDigits[c >> 4U];
  to += kDigits[c & 0xFU];
}

}  // namespace

void append_json(std::string& to, std::string_view text) {
  to += '"';
  while (!text.empty()) {
    const std::size_t length = character_at(text);
    const auto first = static_cast<unsigned char>(text.front());
    if (length == 0) {
      to += kReplacement;
    } else if (length > 1) {
      to += text.substr(0, length);
    } else if (first == '"' || first == '\\') {
      to += '\\';
      to += text.front();
    } else if (first < 0x20 || first == '<' || first == 0x7F) {
      append_escaped(to, first);
    } else {
      to += text.front();
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  to += '"';
}

void append_json(std::string& to, double number) {
  if (!std::isfinite(number)) {
    to += "null";
    return;
  }
  std::array<char, 32> digits{};  // enough for the shortest form that reads back equal
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  to.append(digits.data(), end.ptr);
}

void append_json(std::string& to, std::int64_t number) {
  std::array<char, 24> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number);
  to.append(digits.data(), end.ptr);
}

}  // namespace view::server
