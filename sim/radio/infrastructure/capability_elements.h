#pragma once

#include <cstdint>
#include <span>

#include "hal/types/message.h"
#include "sim/radio/mac/ht_protection.h"
#include "sim/radio/phy/capabilities.h"

namespace sim::radio {

// The elements of HT, VHT and HE (IEEE Std 802.11-2020, 9.4.2.55, 9.4.2.56, 9.4.2.157
// and 9.4.2.158; IEEE Std 802.11ax-2021, 9.4.2.248 and 9.4.2.249). Each states what Capabilities
// has: streams, width and the short guard interval; other optional features are not supported.

/// Appends the capability elements of the classes that a station supports.
void put_capability_elements(hal::Bytes& out, const Capabilities& capabilities);
/// Appends the operation elements, of beacons and association responses. @param channel  primary.
void put_operation_elements(hal::Bytes& out, const Capabilities& capabilities, std::uint8_t channel,
                            const HtOperation& ht);

/// Adds to `capabilities` what an element says. @param id  element ID; @param content  without ID
/// and length. @return false: an element that is too short. Other elements have no effect.
bool take_capability_element(std::uint8_t id, std::span<const std::uint8_t> content,
                             Capabilities& capabilities);

/// Sets `ht` if the element is an HT Operation element.
void take_ht_operation(std::uint8_t id, std::span<const std::uint8_t> content, HtOperation& ht);

}  // namespace sim::radio
