#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace results::record {

/// Writes two lower-case digits per byte.
std::string to_hexadecimal(std::span<const std::uint8_t> bytes);

/// @return none if the number of characters is odd or one of them is not a digit.
std::optional<std::vector<std::uint8_t>> from_hexadecimal(std::string_view text);

}  // namespace results::record
