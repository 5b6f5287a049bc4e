#include "hal/node/routing/node.h"

#include <algorithm>

namespace hal::node::routing {

void Node::after_jitter(std::function<void()> action) {
  if (config.jitter_max <= Duration::zero()) {
    action();
    return;
  }
  const double most = static_cast<double>(config.jitter_max.count());
  const Duration wait{static_cast<std::int64_t>(random.uniform() * most)};
  timers.schedule(now() + wait, std::move(action));
}

PathStatistics Node::lengthened(const PathStatistics& way, const Reception& hop,
                                std::size_t frame_size) const {
  PathStatistics longer = way;
  longer.hops = static_cast<std::uint16_t>(way.hops + 1);
  longer.delay += ports.link.expected_delay();
  longer.energy += ports.link.transmit_energy(frame_size);
  if (ports.link.capabilities().rssi) {
    longer.min_snr_db = way.hops == 0 ? hop.snr_db : std::min(way.min_snr_db, hop.snr_db);
  }
  return longer;
}

}  // namespace hal::node::routing
