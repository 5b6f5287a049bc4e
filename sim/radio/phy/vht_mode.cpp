#include "sim/radio/phy/vht_mode.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

/// Data bits that one encoder makes in a symbol of 3.6 us at 600 Mb/s.
constexpr int kBitsPerEncoder = 2160;

bool is_width(const ModeId& id) { return id.width == 20 || id.width == 40 || id.width == 80; }

double signal_b_bits(std::uint16_t width) { return width == 20 ? 26 : width == 40 ? 27 : 29; }

}  // namespace

int VhtMode::subcarriers_of(const ModeId& id) {
  return id.width == 20 ? 52 : id.width == 40 ? 108 : 234;
}

int VhtMode::encoders_of(const ModeId& id) {
  const CodeRatio ratio = ratio_of(mcs_coding(id.mcs).rate);
  const int bits = coded_bits(id, subcarriers_of(id)) * ratio.information / ratio.coded;
  return (bits + kBitsPerEncoder - 1) / kBitsPerEncoder;
}

bool VhtMode::exists(const ModeId& id) {
  const bool is_in_range = id.modulation == ModulationClass::kVht && id.mcs <= kHighestMcs &&
                           id.streams >= 1 && id.streams <= 4 && is_width(id) &&
                           (id.guard == 800ns || id.guard == 400ns);
  if (!is_in_range) return false;
  const int coded = coded_bits(id, subcarriers_of(id)), encoders = encoders_of(id);
  return coded % encoders == 0 && coded / encoders % ratio_of(mcs_coding(id.mcs).rate).coded == 0;
}

McsMode::Format VhtMode::format_of(const ModeId& id, PpduTimes times) {
  const bool is_standard = times == PpduTimes::kStandard;
  const hal::Duration symbol = 3200ns + id.guard;
  const hal::Duration signal_b = is_standard ? 4us : 0us;
  return {.header = 4us + 8us + 4us + training_fields(id) * 4us + signal_b,
          .header_bits = 24 + 48 + (is_standard ? signal_b_bits(id.width) : 0),
          .symbol = symbol,
          .data_subcarriers = subcarriers_of(id),
          .encoders = encoders_of(id),
          .multiple = is_standard ? 4us : symbol};
}

}  // namespace sim::radio
