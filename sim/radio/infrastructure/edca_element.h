#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "hal/types/message.h"
#include "sim/radio/mac/edca_config.h"

namespace sim::radio {

inline constexpr std::uint8_t kEdcaElement =
    12;  ///< Element ID (IEEE Std 802.11-2020, table 9-92).

/// Unit of TXOP limits, and the largest one that the element can carry (9.4.2.28).
inline constexpr hal::Duration kTxopUnit{32'000};
inline constexpr hal::Duration kLongestTxop = 65'535 * kTxopUnit;

/// Appends the EDCA Parameter Set element (9.4.2.28), with ID and length: windows, AIFSN and TXOP
/// limits, these rounded down to kTxopUnit. No admission control, no power save.
void put_edca_element(hal::Bytes& out, const EdcaConfig& edca);

/// @param content  without ID and length. @return nullopt: it is too short.
std::optional<EdcaConfig> take_edca_element(std::span<const std::uint8_t> content);

}  // namespace sim::radio
