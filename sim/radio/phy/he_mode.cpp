#include "sim/radio/phy/he_mode.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

bool is_he_width(const ModeId& id) { return id.width == 20 || id.width == 40 || id.width == 80; }

/// Of RUs of 242, 484 and 996 tones.
int he_subcarriers(std::uint16_t width) { return width == 20 ? 234 : width == 40 ? 468 : 980; }

hal::Duration training_field(hal::Duration guard, PpduTimes times) {
  if (times == PpduTimes::kNs3) return 8us;
  return (guard == 3200ns ? 12'800ns : 6'400ns) + guard;
}

}  // namespace

bool HeMode::exists(const ModeId& id) {
  return id.modulation == ModulationClass::kHe && id.mcs <= kHighestMcs && id.streams >= 1 &&
         id.streams <= 4 && is_he_width(id) &&
         (id.guard == 800ns || id.guard == 1600ns || id.guard == 3200ns);
}

McsMode::Format HeMode::format_of(const ModeId& id, PpduTimes times) {
  const hal::Duration symbol = 12'800ns + id.guard;
  return {.header = 4us + 4us + 8us + 4us + training_fields(id) * training_field(id.guard, times),
          .header_bits = 24 + 52,
          .symbol = symbol,
          .data_subcarriers = he_subcarriers(id.width),
          .encoders = 1,
          .multiple = symbol};
}

}  // namespace sim::radio
