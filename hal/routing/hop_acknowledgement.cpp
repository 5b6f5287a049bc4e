#include "hal/routing/hop_acknowledgement.h"

#include <utility>

namespace hal::routing {
namespace {

/// Of frames that nobody misses. Without transmit status a tag is never given back.
constexpr LinkTag kNoTag = 0;

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

void HopAcknowledgement::transmit(AgentId next_hop, Bytes packet, LinkTag tag) {
  if (next_hop == kEveryone) {
    link_.transmit(kEveryone, std::move(packet), kNoTag);
    timers_.schedule(timers_.now(), [this, tag] { report_({tag, Verdict::kDelivered}); });
    return;
  }
  const HopNumber number = ++last_number_;
  Pending& pending = pending_[number];
  pending.next_hop = next_hop;
  pending.frame = encode_numbered(number, packet);
  pending.tag = tag;
  pending.timeout = config_.ack_timeout;
  attempt(number, pending);
}

void HopAcknowledgement::attempt(HopNumber number, Pending& pending) {
  ++pending.attempts;
  pending.timer =
      timers_.schedule(timers_.now() + pending.timeout, [this, number] { on_timeout(number); });
  pending.timeout *= 2;
  link_.transmit(pending.next_hop, pending.frame, kNoTag);
}

void HopAcknowledgement::on_timeout(HopNumber number) {
  Pending& pending = pending_.at(number);
  if (pending.attempts < config_.ack_attempts) return attempt(number, pending);
  const LinkTag tag = pending.tag;
  pending_.erase(number);
  report_({tag, Verdict::kRetryLimit});
}

bool HopAcknowledgement::on_numbered(AgentId from, HopNumber number) {
  link_.transmit(from, encode(HopAck{number}), kNoTag);
  return received_.note({from, number}, timers_.now()).second;
}

void HopAcknowledgement::on_ack(AgentId from, HopNumber number) {
  const auto pending = pending_.find(number);
  if (pending == pending_.end() || pending->second.next_hop != from) return;
  timers_.cancel(pending->second.timer);
  const LinkTag tag = pending->second.tag;
  pending_.erase(pending);
  report_({tag, Verdict::kDelivered});
}

}  // namespace hal::routing
