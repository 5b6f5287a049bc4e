#include "sim/radio/channel/links.h"

namespace sim::radio {

Tick tick(hal::Time time) {
  constexpr int kShift = 20;
  const std::int64_t ticks = time.time_since_epoch().count() >> kShift;
  return static_cast<Tick>(std::min<std::int64_t>(ticks, kForEver - 1));
}

}  // namespace sim::radio
