#include "sim/radio/channel/friis.h"

#include "sim/radio/channel/power_law.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> make(const FriisConfig& /*config*/, const PropagationConfig& air,
                                     const Ground& /*ground*/) {
  return std::make_unique<PowerLaw>(air.wavelength, 2);
}

}  // namespace sim::radio
