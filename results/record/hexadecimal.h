#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace results::record {

/// Two lower-case digits per byte.
std::string to_hexadecimal(std::span<const std::uint8_t> bytes);

/// @return none: an odd number of characters, or one that is no digit.
std::optional<std::vector<std::uint8_t>> from_hexadecimal(std::string_view text);

}  // namespace results::record
