#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace view::server {

/// Parses a whole number without a sign, as it occurs in addresses. None for "", "01", "1x", and
/// numbers that do not fit.
inline std::optional<std::int64_t> plain_integer(std::string_view text) {
  if (text.empty() || (text.size() > 1 && text.front() == '0') || text.front() == '-') return {};
  std::int64_t number = 0;
  const auto end = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end.ec != std::errc{} || end.ptr != text.data() + text.size()) return {};
  return number;
}

}  // namespace view::server
