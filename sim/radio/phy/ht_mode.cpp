#include "sim/radio/phy/ht_mode.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

/// N_DBPS of 300 Mb/s with the long guard interval.
constexpr int kBitsOfOneEncoder = 1200;

}  // namespace

bool HtMode::exists(const ModeId& id) {
  return id.modulation == ModulationClass::kHt && id.mcs <= kHighestMcs && id.streams >= 1 &&
         id.streams <= 4 && (id.width == 20 || id.width == 40) &&
         (id.guard == 800ns || id.guard == 400ns);
}

McsMode::Format HtMode::format_of(const ModeId& id, PpduTimes times) {
  const int subcarriers = id.width == 20 ? 52 : 108;
  const CodeRatio ratio = ratio_of(mcs_coding(id.mcs).rate);
  const int bits = coded_bits(id, subcarriers) * ratio.information / ratio.coded;
  const hal::Duration symbol = 3200ns + id.guard;
  return {.header = 4us + 8us + 4us + training_fields(id) * 4us,
          .header_bits = 24 + 48,
          .symbol = symbol,
          .data_subcarriers = subcarriers,
          .encoders = bits > kBitsOfOneEncoder ? 2 : 1,
          .multiple = times == PpduTimes::kNs3 ? symbol : 4us};
}

}  // namespace sim::radio
