#include "sim/radio/rate/rate_control.h"

#include "sim/radio/rate/aarf.h"
#include "sim/radio/rate/ideal.h"
#include "sim/radio/rate/minstrel.h"
#include "sim/radio/rate/minstrel_ht.h"

namespace sim::radio {

std::unique_ptr<RateControl> make_rate_control(const RateControlConfig& config,
                                               const RateLadders& ladders,
                                               hal::RandomStream random) {
  switch (config.kind) {
    case RateControlKind::kAarf:
      return std::make_unique<Aarf>(config, ladders);
    case RateControlKind::kMinstrel:
      return std::make_unique<Minstrel>(config, ladders, random);
    case RateControlKind::kMinstrelHt:
      return std::make_unique<MinstrelHt>(config, ladders, random);
    case RateControlKind::kIdeal:
      return std::make_unique<Ideal>(config, ladders);
    case RateControlKind::kFixed:
      break;
  }
  return std::make_unique<FixedRate>(ladders);
}

}  // namespace sim::radio
