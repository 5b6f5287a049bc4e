#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/result.h"

namespace hal::robot::drivers {

/// Reads a JSON array of exactly `count` numbers (RFC 8259), surrounded only by white space.
/// Errors: kProtocol with the text found.
Result<std::vector<double>> parse_json_numbers(std::string_view text, std::size_t count);

/// Writes such an array: each number in the shortest form that reads back to the same bits. @pre
/// finite.
std::string json_numbers(std::span<const double> numbers);

}  // namespace hal::robot::drivers
