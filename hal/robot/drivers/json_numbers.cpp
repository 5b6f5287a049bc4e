#include "hal/robot/drivers/json_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace hal::robot::drivers {
namespace {

/// The start of an answer, printable on one line of a message.
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
  constexpr bool kThrows = false;
  const nlohmann::json answer = nlohmann::json::parse(text, nullptr, kThrows);
  if (!answer.is_array() || !std::ranges::all_of(answer, &nlohmann::json::is_number)) {
    return fail(Errc::kProtocol,
                fmt::format("'{}' is not a JSON array of {} numbers", excerpt(text), count));
  }
  if (answer.size() != count) {
    return fail(Errc::kProtocol,
                fmt::format("{} numbers, {} expected: '{}'", answer.size(), count, excerpt(text)));
  }
  return answer.get<std::vector<double>>();
}

std::string json_numbers(std::span<const double> numbers) {
  return fmt::format("[{}]", fmt::join(numbers, ","));
}

}  // namespace hal::robot::drivers
