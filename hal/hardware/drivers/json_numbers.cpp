#include "hal/hardware/drivers/json_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace hal::hardware {
namespace {

constexpr std::string_view kWhiteSpace = " \t\r\n";

void skip_blanks(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(kWhiteSpace), text.size()));
}

bool take(std::string_view& text, char expected) {
  skip_blanks(text);
  if (!text.starts_with(expected)) return false;
  text.remove_prefix(1);
  return true;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// from_chars also takes "inf", "01" and "1.", which JSON does not.
bool is_json_number(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  if (text.empty() || !is_digit(text.front())) return false;
  if (text.size() > 1 && text[0] == '0' && is_digit(text[1])) return false;
  const std::size_t point = text.find('.');
  return point == std::string_view::npos || (point + 1 < text.size() && is_digit(text[point + 1]));
}

std::optional<double> take_number(std::string_view& text) {
  skip_blanks(text);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const auto length = static_cast<std::size_t>(end - text.data());
  if (error != std::errc{} || !std::isfinite(value) || !is_json_number(text.substr(0, length))) {
    return std::nullopt;
  }
  text.remove_prefix(length);
  return value;
}

std::optional<std::vector<double>> take_array(std::string_view& text) {
  if (!take(text, '[')) return std::nullopt;
  std::vector<double> numbers;
  if (take(text, ']')) return numbers;
  do {
    const auto number = take_number(text);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  } while (take(text, ','));
  if (!take(text, ']')) return std::nullopt;
  return numbers;
}

/// The start of an answer, fit for one line of a message.
std::string excerpt(std::string_view text) {
  constexpr std::size_t kShown = 60;
  std::string shown(text.substr(0, kShown));
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.size() > kShown ? shown + "…" : shown;
}

}  // namespace

Result<std::vector<double>> parse_json_numbers(std::string_view text, std::size_t count) {
  std::string_view rest = text;
  auto numbers = take_array(rest);
  skip_blanks(rest);
  if (!numbers || !rest.empty()) {
    return fail(Errc::kProtocol,
                fmt::format("'{}' is not a JSON array of {} numbers", excerpt(text), count));
  }
  if (numbers->size() != count) {
    return fail(Errc::kProtocol, fmt::format("{} numbers, {} expected: '{}'", numbers->size(),
                                             count, excerpt(text)));
  }
  return std::move(*numbers);
}

std::string json_numbers(std::span<const double> numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

}  // namespace hal::hardware
