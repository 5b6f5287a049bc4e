#include "hal/node/routing/hop_acknowledgement.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace hal::node::routing {
namespace {

/// Tag of frames whose result is not needed. Without transmit status the link never returns a tag.
constexpr LinkTag kUnwatched = 0;

}  // namespace

HopAcknowledgement::HopAcknowledgement(const RoutingConfig& config, Link& link, Timers& timers,
                                       Report report)
    : config_(config),
      link_(link),
      timers_(timers),
      report_(std::move(report)),
      last_number_(config.first_sequence) {}

LinkCapabilities HopAcknowledgement::capabilities() const {
  return {.tx_status = true, .rssi = link_.capabilities().rssi};
}

std::size_t HopAcknowledgement::Lane::in_flight_of(std::size_t category) const {
  return static_cast<std::size_t>(std::ranges::count_if(in_flight, [category](const auto& sent) {
    return access_category(sent.second.options.priority) == category;
  }));
}

void HopAcknowledgement::transmit(AgentId next_hop, Bytes packet, const LinkOptions& options) {
  if (next_hop == kEveryone) {
    link_.transmit(kEveryone, std::move(packet), {kUnwatched, options.priority});
    return report_soon(options.tag, Verdict::kDelivered);
  }
  Lane& lane = lanes_[next_hop];
  const std::size_t category = access_category(options.priority);
  const bool has_room =
      lane.in_flight_of(category) < kWindow || lane.waiting[category].size() < config_.buffer_limit;
  if (!has_room) return report_soon(options.tag, Verdict::kQueueFull);
  lane.waiting[category].push_back({std::move(packet), options});
  fill(next_hop);
}

void HopAcknowledgement::report_soon(LinkTag tag, Verdict verdict) {
  timers_.schedule(timers_.now(), [this, tag, verdict] { report_({tag, verdict}); });
}

/// Sends waiting frames to the neighbour as far as the windows allow, the highest category first.
void HopAcknowledgement::fill(AgentId next_hop) {
  const auto found = lanes_.find(next_hop);
  if (found == lanes_.end()) return;
  Lane& lane = found->second;
  for (std::size_t left = kAccessCategories; left > 0; --left) {
    send_waiting(next_hop, lane, left - 1);
  }
  if (lane.in_flight.empty()) lanes_.erase(found);
}

void HopAcknowledgement::send_waiting(AgentId next_hop, Lane& lane, std::size_t category) {
  std::deque<Waiting>& waiting = lane.waiting[category];
  while (!waiting.empty() && lane.in_flight_of(category) < kWindow) {
    const Waiting next = std::move(waiting.front());
    waiting.pop_front();
    const HopNumber number = ++last_number_;
    InFlight& sent = lane.in_flight[number];
    sent.frame = encode_numbered(number, next.packet);
    sent.options = next.options;
    sent.timeout = config_.ack_timeout;
    attempt(next_hop, number, sent);
  }
}

void HopAcknowledgement::attempt(AgentId next_hop, HopNumber number, InFlight& sent) {
  ++sent.attempts;
  sent.timer = timers_.schedule(timers_.now() + sent.timeout,
                                [this, next_hop, number] { on_timeout(next_hop, number); });
  sent.timeout *= 2;
  link_.transmit(next_hop, sent.frame, {kUnwatched, sent.options.priority});
}

void HopAcknowledgement::on_timeout(AgentId next_hop, HopNumber number) {
  InFlight& sent = lanes_.at(next_hop).in_flight.at(number);
  if (sent.attempts < config_.ack_attempts) {
    attempt(next_hop, number, sent);
  } else {
    give_up(next_hop);
  }
}

void HopAcknowledgement::give_up(AgentId neighbour) {
  const auto lane = lanes_.extract(neighbour);
  if (lane.empty()) return;
  std::vector<LinkTag> failed;
  for (const auto& [number, sent] : lane.mapped().in_flight) {
    timers_.cancel(sent.timer);
    failed.push_back(sent.options.tag);
  }
  for (const auto& waiting : lane.mapped().waiting) {
    for (const Waiting& frame : waiting) failed.push_back(frame.options.tag);
  }
  // The receiver of a report may send the next frame: do not access the lane any more.
  for (const LinkTag tag : failed) report_({tag, Verdict::kRetryLimit});
}

bool HopAcknowledgement::on_numbered(AgentId from, HopNumber number) {
  return received_.note({from, number}, timers_.now()).second;
}

void HopAcknowledgement::acknowledge(AgentId neighbour, HopNumber number, Priority priority) {
  link_.transmit(neighbour, encode(HopAck{number}), {kUnwatched, priority});
}

void HopAcknowledgement::on_ack(AgentId from, HopNumber number) {
  const auto lane = lanes_.find(from);
  if (lane == lanes_.end()) return;
  const auto sent = lane->second.in_flight.extract(number);
  if (sent.empty()) return;
  timers_.cancel(sent.mapped().timer);
  fill(from);
  report_({sent.mapped().options.tag, Verdict::kDelivered});
}

}  // namespace hal::node::routing
