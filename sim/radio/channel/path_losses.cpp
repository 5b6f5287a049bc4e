#include "sim/radio/channel/path_losses.h"

namespace sim::radio {

std::unique_ptr<const PathLoss> path_loss(const PathLossConfig& config,
                                          const PropagationConfig& air, const Ground& ground) {
  return std::visit([&](const auto& one) { return make(one, air, ground); }, config);
}

}  // namespace sim::radio
