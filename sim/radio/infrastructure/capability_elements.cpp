#include "sim/radio/infrastructure/capability_elements.h"

#include <algorithm>
#include <bit>

#include "sim/radio/mac/mac_address.h"

namespace sim::radio {
namespace {

// Element IDs (table 9-92), and those after kExtension.
constexpr std::uint8_t kHtCapabilities = 45, kHtOperation = 61;
constexpr std::uint8_t kVhtCapabilities = 191, kVhtOperation = 192;
constexpr std::uint8_t kExtension = 255, kHeCapabilities = 35, kHeOperation = 36;

// Sizes of the contents; of HE with the extended ID.
constexpr std::size_t kHtCapabilitiesSize = 26, kHtOperationSize = 22;
constexpr std::size_t kVhtCapabilitiesSize = 12, kVhtOperationSize = 5;
constexpr std::size_t kHeCapabilitiesSize = 22, kHeOperationSize = 7;

// HT Capability Information (figure 9-359).
constexpr std::uint8_t kHt40 = 0x02, kHtShort20 = 0x20, kHtShort40 = 0x40;
constexpr std::uint8_t kNoPowerSave = 0x0c;  // SM Power Save: disabled
constexpr std::size_t kHtMcsSet = 3;         // after the information and the A-MPDU parameters

/// Second octet of the HT Operation Information: HT Protection, and two flags.
constexpr std::size_t kHtProtectionAt = 2;
constexpr std::uint8_t kHtProtection = 0x03, kNonGreenfield = 0x04, kObssNonHt = 0x10;

/// Secondary Channel Offset (9.4.2.56): above, below.
constexpr std::uint8_t kAbove = 1, kBelow = 3, kAnyWidth = 4;

// VHT Capabilities Information and HE PHY Capabilities Information.
constexpr std::uint8_t kVhtShort80 = 0x20;
constexpr std::size_t kVhtMcsMap = 4, kHePhy = 7, kHeMcsMap = 18;
constexpr std::uint8_t kHe40In24 = 0x02, kHe40And80In5 = 0x04;
/// Two bits for each number of streams: the highest MCS, or none.
constexpr unsigned kHighestMcs = 2, kNoStreams = 3, kMostStreams = 8;

std::uint16_t mcs_map(std::uint8_t streams, unsigned highest) {
  unsigned map = 0;
  for (unsigned i = 0; i < kMostStreams; ++i) map |= (i < streams ? highest : kNoStreams) << 2 * i;
  return static_cast<std::uint16_t>(map);
}

std::uint8_t streams_in(std::uint16_t map) {
  std::uint8_t streams = 0;
  while (streams < kMostStreams && (map >> 2 * streams & 3U) != kNoStreams) ++streams;
  return streams;
}

void put_sized(hal::Bytes& out, std::uint8_t id, const hal::Bytes& content) {
  out.push_back(id);
  out.push_back(static_cast<std::uint8_t>(content.size()));
  out.insert(out.end(), content.begin(), content.end());
}

hal::Bytes ht_capabilities(const Capabilities& own) {
  hal::Bytes content(kHtCapabilitiesSize);
  unsigned information = kNoPowerSave;
  if (own.width >= 40) information |= kHt40;
  if (own.short_guard) information |= kHtShort20 | (own.width >= 40 ? kHtShort40 : 0U);
  content[0] = static_cast<std::uint8_t>(information);
  content[2] = 0x03;  // A-MPDU of 65,535 bytes, no minimum spacing
  std::fill_n(content.begin() + kHtMcsSet, own.streams, std::uint8_t{0xff});
  return content;
}

/// The first channel of the block of channels of this width in which the primary channel is.
std::uint8_t first_of_block(std::uint8_t channel, std::uint8_t channels) {
  const int low = channel < 100 ? 36 : channel < 149 ? 100 : 149;
  const int place = (channel - low) / 4;
  return static_cast<std::uint8_t>(low + place / channels * channels * 4);
}

/// In 2.4 GHz the secondary channel is above, if there is one.
std::uint8_t secondary(std::uint8_t channel) {
  constexpr std::uint8_t kHighestWithAbove = 9;
  if (channel < 36) return channel <= kHighestWithAbove ? kAbove : kBelow;
  return first_of_block(channel, 2) == channel ? kAbove : kBelow;
}

hal::Bytes ht_operation(const Capabilities& own, std::uint8_t channel, const HtOperation& ht) {
  hal::Bytes content(kHtOperationSize);
  content[0] = channel;
  if (own.width >= 40) content[1] = secondary(channel) | kAnyWidth;
  content[kHtProtectionAt] = static_cast<std::uint8_t>(static_cast<unsigned>(ht.protection) |
                                                       (ht.non_greenfield ? kNonGreenfield : 0U) |
                                                       (ht.obss_non_ht ? kObssNonHt : 0U));
  return content;
}

hal::Bytes vht_capabilities(const Capabilities& own) {
  hal::Bytes content(kVhtCapabilitiesSize);
  constexpr std::uint8_t kLongestMpdu = 2;  // 11,454 bytes
  content[0] = static_cast<std::uint8_t>(kLongestMpdu | (own.short_guard ? kVhtShort80 : 0));
  content[2] = 0x80, content[3] = 0x03;  // longest A-MPDU: 2^20 - 1 bytes, bits 23 to 25
  const std::uint16_t map = mcs_map(own.streams, kHighestMcs);
  for (const std::size_t at : {kVhtMcsMap, kVhtMcsMap + 4}) {  // receive, transmit
    content[at] = static_cast<std::uint8_t>(map);
    content[at + 1] = static_cast<std::uint8_t>(map >> 8);
  }
  return content;
}

hal::Bytes vht_operation(const Capabilities& own, std::uint8_t channel) {
  const bool is_wide = own.width >= 80;
  constexpr std::uint8_t kToCentre = 6;  // from the first of four channels
  const std::uint8_t centre =
      is_wide ? static_cast<std::uint8_t>(first_of_block(channel, 4) + kToCentre) : std::uint8_t{0};
  const std::uint16_t basic = mcs_map(1, 0);
  return {static_cast<std::uint8_t>(is_wide ? 1 : 0), centre, 0, static_cast<std::uint8_t>(basic),
          static_cast<std::uint8_t>(basic >> 8)};
}

hal::Bytes he_capabilities(const Capabilities& own) {
  hal::Bytes content(kHeCapabilitiesSize);
  content[0] = kHeCapabilities;
  const bool is_5ghz = own.supports(ModulationClass::kVht);
  const std::uint8_t wide = is_5ghz ? kHe40And80In5 : kHe40In24;
  content[kHePhy] = own.width >= 40 ? wide : std::uint8_t{0};
  const std::uint16_t map = mcs_map(own.streams, kHighestMcs);
  for (const std::size_t at : {kHeMcsMap, kHeMcsMap + 2}) {
    content[at] = static_cast<std::uint8_t>(map);
    content[at + 1] = static_cast<std::uint8_t>(map >> 8);
  }
  return content;
}

hal::Bytes he_operation() {
  hal::Bytes content(kHeOperationSize);
  content[0] = kHeOperation;
  content[4] = 1;  // BSS colour
  const std::uint16_t basic = mcs_map(1, 0);
  content[5] = static_cast<std::uint8_t>(basic);
  content[6] = static_cast<std::uint8_t>(basic >> 8);
  return content;
}

void add_class(Capabilities& capabilities, ModulationClass modulation) {
  capabilities.classes =
      static_cast<std::uint8_t>(capabilities.classes | Capabilities::bit(modulation));
}

std::uint16_t map_at(std::span<const std::uint8_t> content, std::size_t at) {
  return static_cast<std::uint16_t>(get_little_endian(content.subspan(at), 2));
}

bool take_ht(std::span<const std::uint8_t> content, Capabilities& all) {
  if (content.size() < kHtCapabilitiesSize) return false;
  add_class(all, ModulationClass::kHt);
  all.width = std::max<std::uint16_t>(all.width, (content[0] & kHt40) != 0 ? 40 : 20);
  all.short_guard = (content[0] & kHtShort20) != 0;
  const auto set = content.subspan(kHtMcsSet, 4);
  all.streams = static_cast<std::uint8_t>(std::ranges::count(set, 0xff));
  return true;
}

bool take_vht(std::span<const std::uint8_t> content, Capabilities& all) {
  if (content.size() < kVhtCapabilitiesSize) return false;
  add_class(all, ModulationClass::kVht);
  all.streams = streams_in(map_at(content, kVhtMcsMap));
  return true;
}

bool take_he(std::span<const std::uint8_t> content, Capabilities& all) {
  if (content.size() < kHeCapabilitiesSize) return false;
  add_class(all, ModulationClass::kHe);
  all.streams = streams_in(map_at(content, kHeMcsMap));
  return true;
}

}  // namespace

void put_capability_elements(hal::Bytes& out, const Capabilities& capabilities) {
  if (!capabilities.supports(ModulationClass::kHt)) return;
  put_sized(out, kHtCapabilities, ht_capabilities(capabilities));
  if (capabilities.supports(ModulationClass::kVht)) {
    put_sized(out, kVhtCapabilities, vht_capabilities(capabilities));
  }
  if (capabilities.supports(ModulationClass::kHe)) {
    put_sized(out, kExtension, he_capabilities(capabilities));
  }
}

void put_operation_elements(hal::Bytes& out, const Capabilities& capabilities, std::uint8_t channel,
                            const HtOperation& ht) {
  if (!capabilities.supports(ModulationClass::kHt)) return;
  put_sized(out, kHtOperation, ht_operation(capabilities, channel, ht));
  if (capabilities.supports(ModulationClass::kVht)) {
    put_sized(out, kVhtOperation, vht_operation(capabilities, channel));
  }
  if (capabilities.supports(ModulationClass::kHe)) put_sized(out, kExtension, he_operation());
}

bool take_capability_element(std::uint8_t id, std::span<const std::uint8_t> content,
                             Capabilities& capabilities) {
  if (id == kHtCapabilities) return take_ht(content, capabilities);
  if (id == kVhtCapabilities) return take_vht(content, capabilities);
  if (id == kVhtOperation && content.size() >= kVhtOperationSize && content[0] == 1) {
    capabilities.width = 80;
  }
  const bool is_he = id == kExtension && !content.empty() && content[0] == kHeCapabilities;
  return !is_he || take_he(content, capabilities);
}

void take_ht_operation(std::uint8_t id, std::span<const std::uint8_t> content, HtOperation& ht) {
  if (id != kHtOperation || content.size() <= kHtProtectionAt) return;
  const std::uint8_t flags = content[kHtProtectionAt];
  ht = {.protection = static_cast<HtProtection>(flags & kHtProtection),
        .non_greenfield = (flags & kNonGreenfield) != 0,
        .obss_non_ht = (flags & kObssNonHt) != 0};
}

}  // namespace sim::radio
