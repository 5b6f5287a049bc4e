#include "hal/node/routing/anthocnet_mac_time.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing::anthocnet {

MacTime::MacTime(Link& link, Timers& timers, double alpha, Duration hop_time)
    : link_(link), timers_(timers), alpha_(alpha), mac_time_(to_seconds(hop_time)) {}

void MacTime::transmit(AgentId next_hop, Bytes frame, const LinkOptions& options) {
  if (capabilities().tx_status) {
    under_way_.emplace(options.tag, UnderWay{next_hop, timers_.now()});
  }
  link_.transmit(next_hop, std::move(frame), options);
}

Duration MacTime::expected_delay() const {
  if (!capabilities().tx_status) return link_.expected_delay();
  return from_seconds(static_cast<double>(under_way_.size() + 1) * mac_time_);  // (A2)
}

std::optional<AgentId> MacTime::on_transmitted(const Transmission& transmission) {
  const auto frame = under_way_.extract(transmission.tag);
  if (frame.empty()) return std::nullopt;
  const auto [next_hop, handed_over] = frame.mapped();
  const bool was_tried =
      transmission.verdict == Verdict::kDelivered || transmission.verdict == Verdict::kRetryLimit;
  if (!was_tried) return next_hop;  // it was never at the head of the queue
  const Time now = timers_.now();
  if (transmission.verdict == Verdict::kDelivered && next_hop != kEveryone) {
    const double took = to_seconds(now - std::max(handed_over, last_end_));
    mac_time_ = alpha_ * mac_time_ + (1 - alpha_) * took;  // (A1)
  }
  last_end_ = now;
  return next_hop;
}

}  // namespace hal::node::routing::anthocnet
