#include "results/record/broadcast_watch.h"

#include <algorithm>

#include "hal/node/routing/frame.h"
#include "hal/node/routing/one_hop.h"

namespace results::record {
namespace {

/// Upper limit of the propagation delay across any field (300 km).
constexpr hal::Duration kLongestPropagation = std::chrono::milliseconds{1};

/// Number of the message that its sender broadcasts with this frame; none if the frame is another
/// one.
std::optional<hal::MessageId> own_broadcast(const sim::radio::Frame& frame) {
  if (!frame.is_broadcast() || frame.ethertype != sim::radio::kEthertypeRouting || !frame.payload) {
    return std::nullopt;
  }
  if (frame.source() != frame.transmitter) return std::nullopt;  // an access point passes it on
  const auto one_hop =
      hal::node::routing::parse_one_hop(*frame.payload, frame.transmitter, hal::kEveryone);
  if (one_hop) return one_hop->id;
  const auto routed = hal::node::routing::parse_frame(*frame.payload);
  const auto* packet = routed ? hal::node::routing::packet_in(*routed) : nullptr;
  const auto* data = packet ? std::get_if<hal::node::routing::Data>(packet) : nullptr;
  if (data == nullptr || data->header.source != frame.transmitter) return std::nullopt;
  return data->id;
}

}  // namespace

void BroadcastWatch::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  const auto message = own_broadcast(frame);
  if (!message) return;
  if (frame.transmitter.value >= last_.size()) last_.resize(frame.transmitter.value + 1u);
  std::optional<OnAir>& last = last_[frame.transmitter.value];
  if (last) settle(frame.transmitter, *last);
  last = {.frame = frame.id, .message = *message, .end = at + frame.airtime + kLongestPropagation};
}

void BroadcastWatch::on_reception(const sim::radio::Frame& frame, hal::Verdict verdict) {
  if (!frame.is_broadcast()) return;
  if (frame.transmitter.value >= last_.size()) return;
  std::optional<OnAir>& last = last_[frame.transmitter.value];
  if (!last || last->frame != frame.id) return;
  if (verdict == hal::Verdict::kDelivered) last->heard = true;
  ++last->losses[static_cast<std::size_t>(verdict)];
}

void BroadcastWatch::finish(hal::Time ended_at) {
  for (std::size_t sender = 0; sender < last_.size(); ++sender) {
    const std::optional<OnAir>& last = last_[sender];
    if (!last || last->end > ended_at) continue;
    settle(hal::AgentId{static_cast<std::uint16_t>(sender)}, *last);
  }
  last_.clear();
}

void BroadcastWatch::settle(hal::AgentId sender, const OnAir& broadcast) const {
  if (broadcast.heard) return;
  const auto& losses = broadcast.losses;
  const auto most = std::max_element(losses.begin(), losses.end());
  const auto why = *most == 0 ? hal::Verdict::kBelowSensitivity
                              : static_cast<hal::Verdict>(most - losses.begin());
  unheard_(sender, broadcast.message, why);
}

}  // namespace results::record
