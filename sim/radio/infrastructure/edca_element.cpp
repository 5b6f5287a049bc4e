#include "sim/radio/infrastructure/edca_element.h"

#include <array>
#include <bit>

#include "sim/radio/mac/mac_address.h"

namespace sim::radio {
namespace {

constexpr std::size_t kEdcaSize = 18, kBeforeRecords = 2, kRecordSize = 4;
constexpr unsigned kAifsnMask = 0x0f, kAciShift = 5, kAciMask = 3;

/// Access categories by their index, the ACI (table 9-154).
constexpr std::array kByAci = {AccessCategory::kBestEffort, AccessCategory::kBackground,
                               AccessCategory::kVideo, AccessCategory::kVoice};

/// 2^exponent - 1 is the window.
unsigned exponent_of(std::uint32_t window) { return static_cast<unsigned>(std::bit_width(window)); }

std::uint32_t window_of(unsigned exponent) { return (1U << exponent) - 1; }

}  // namespace

void put_edca_element(hal::Bytes& out, const EdcaConfig& edca) {
  out.push_back(kEdcaElement);
  out.push_back(kEdcaSize);
  put_little_endian(out, 0, kBeforeRecords);  // QoS Info, Update EDCA Info
  for (unsigned aci = 0; aci < kByAci.size(); ++aci) {
    const AccessParameters& c = edca.of(kByAci[aci]);
    out.push_back(static_cast<std::uint8_t>((c.aifsn & kAifsnMask) | aci << kAciShift));
    out.push_back(static_cast<std::uint8_t>(exponent_of(c.cw_min) | exponent_of(c.cw_max) << 4));
    put_little_endian(out, static_cast<std::uint64_t>(c.txop_limit / kTxopUnit), 2);
  }
}

std::optional<EdcaConfig> take_edca_element(std::span<const std::uint8_t> content) {
  if (content.size() < kEdcaSize) return std::nullopt;
  EdcaConfig edca;
  for (std::size_t i = 0; i < kByAci.size(); ++i) {
    const auto record = content.subspan(kBeforeRecords + i * kRecordSize, kRecordSize);
    AccessParameters& c = edca.of(kByAci[record[0] >> kAciShift & kAciMask]);
    c.aifsn = record[0] & kAifsnMask;
    c.cw_min = window_of(record[1] & 0x0fU);
    c.cw_max = window_of(record[1] >> 4);
    c.txop_limit = static_cast<std::int64_t>(get_little_endian(record.subspan(2), 2)) * kTxopUnit;
  }
  return edca;
}

}  // namespace sim::radio
