#include "sim/radio/infrastructure/bss_mac.h"

#include <algorithm>
#include <utility>

#include "sim/radio/mac/lifetime.h"

namespace sim::radio {

BssMac::BssMac(const Context& context, const DcfConfig& config, std::unique_ptr<Ieee80211Mac> dcf)
    : MacBase(context),
      config_(config),
      dcf_(std::move(dcf)),
      queues_(dcf_->queues()),
      most_handed_(config.qos && queues_ == nullptr
                       ? std::min<std::size_t>(std::size_t{2} * config.aggregation.block_ack_window,
                                               config.contention.queue_limit)
                       : 1) {
  dcf_->set_listener(*this);
  if (queues_ != nullptr) queues_->set_client(*this);
}

void BssMac::transmit(const MacRequest& request) {
  check(request);
  Waiting waiting{request, agent(), now()};
  if (!radio_on()) return end_later(std::move(waiting), hal::Verdict::kRadioOff);
  if (!queue_data(waiting)) end_later(std::move(waiting), hal::Verdict::kQueueFull);
}

void BssMac::set_radio(bool on) {
  if (on == radio_on()) return;
  dcf_->set_radio(on);  // ends the request in service
  if (!on) {
    management_.clear();
    for (Waiting& waiting : std::exchange(data_, {})) {
      end_later(std::move(waiting), hal::Verdict::kRadioOff);
    }
  }
  on_radio(on);
}

bool BssMac::queue_data(Waiting waiting) {
  const hal::AgentId source = waiting.source;
  const MacRequest request = waiting.request;
  if (!push(std::move(waiting))) return false;
  if (source != agent()) observer().on_relay_queued(now(), {agent(), source, request});
  serve();
  return true;
}

/// @return false: the queue is full.
bool BssMac::push(Waiting waiting) {
  if (queues_ != nullptr) return dcf_->queue(std::move(waiting));
  discard_expired();
  if (queued() >= config_.contention.queue_limit) return false;
  data_.push_back(std::move(waiting));
  return true;
}

std::size_t BssMac::queued() const {
  return data_.size() + serving_.size() + (queues_ == nullptr ? 0 : queues_->waiting());
}

std::size_t BssMac::room() const {
  if (queues_ != nullptr) return dcf_->room();
  const std::size_t limit = config_.contention.queue_limit;
  return limit - std::min(limit, queued());
}

void BssMac::send_management(FrameType type, hal::AgentId to, hal::AgentId bssid, hal::Bytes body) {
  MacRequest frame{.destination = to,
                   .ethertype = 0,
                   .priority = 0,
                   .payload = std::make_shared<const hal::Bytes>(std::move(body)),
                   .tag = 0,
                   .header = {.type = type, .ds = Ds::kNone, .address3 = bssid}};
  // A new management frame replaces a waiting one of the same type to the same station, and keeps
  // its place in the queue.
  const auto earlier = std::ranges::find_if(management_, [&frame](const MacRequest& other) {
    return other.destination == frame.destination && other.header.type == frame.header.type;
  });
  if (earlier != management_.end()) {
    *earlier = std::move(frame);
  } else if (type == FrameType::kBeacon) {
    management_.push_front(std::move(frame));
  } else {
    management_.push_back(std::move(frame));
  }
  serve();
}

void BssMac::lose(const Frame& frame) {
  const MacRequest lost{.destination = frame.receiver,
                        .ethertype = frame.ethertype,
                        .priority = frame.priority,
                        .payload = frame.payload,
                        .tag = 0,
                        .group = frame.group};
  lose_relay(frame.source(), lost, hal::Verdict::kNoRoute);
}

void BssMac::lose_relay(hal::AgentId source, const MacRequest& request, hal::Verdict verdict) {
  observer().on_relay_lost(now(), source, request, verdict);
  observer().on_msdu_end(now(), {agent(), source, request},
                         {.verdict = verdict, .has_waited = false});
}

MacRequest BssMac::data_frame(const Waiting& waiting, hal::AgentId receiver, Ds ds) {
  MacRequest frame = waiting.request;
  frame.header = {.type = FrameType::kData,
                  .ds = ds,
                  .address3 = ds == Ds::kTo ? frame.destination : waiting.source};
  frame.destination = receiver;
  return frame;
}

/// The requests at the front are the oldest.
void BssMac::discard_expired() {
  while (!data_.empty()) {
    const auto lifetime = lifetime_of(config_, data_.front().request.priority);
    if (!lifetime || now() - data_.front().since <= *lifetime) return;
    end_later(std::move(data_.front()), hal::Verdict::kExpired);
    data_.pop_front();
  }
}

void BssMac::serve() {
  while (handed_ < most_handed_ && radio_on()) {
    if (!management_.empty()) {
      const MacRequest frame = std::move(management_.front());
      management_.pop_front();
      hand_down(frame);
      continue;
    }
    if (queues_ != nullptr) break;
    discard_expired();
    if (data_.empty() || !is_open()) return;
    Waiting waiting = std::move(data_.front());
    data_.pop_front();
    if (const std::optional<MacRequest> frame = on_turn(std::move(waiting))) hand_down(*frame);
  }
  if (queues_ != nullptr) dcf_->serve();
}

std::optional<MacRequest> BssMac::on_turn(WaitingMsdu waiting) {
  std::optional<MacRequest> frame = frame_for(waiting);
  if (!frame) return std::nullopt;
  frame->header.since = waiting.since;
  frame->header.ticket = ++tickets_;
  serving_.emplace(tickets_, Serving{std::move(waiting), now()});
  return frame;
}

void BssMac::on_dropped(WaitingMsdu waiting, hal::Verdict verdict) {
  end_later(std::move(waiting), verdict);
}

void BssMac::hand_down(const MacRequest& frame) {
  ++handed_;
  dcf_->transmit(frame);
}

void BssMac::on_sent(const MacRequest& request, hal::Verdict verdict) {
  const hal::Time previous_end = std::exchange(last_end_, now());
  auto served = serving_.extract(request.header.ticket);
  if (served.empty() || queues_ == nullptr) --handed_;
  if (served.empty()) {
    on_management_sent(request, verdict);
    return serve();
  }
  const Serving& one = served.mapped();
  if (verdict == hal::Verdict::kDelivered) {
    learn_service_time(now() - std::max(one.since, previous_end));
  }
  serve();
  end(one.waiting, verdict);
}

void BssMac::end_later(Waiting waiting, hal::Verdict verdict) {
  auto shared = std::make_shared<const Waiting>(std::move(waiting));
  events().schedule(now(), Rank::kRadio, agent(),
                    [this, shared, verdict] { end(*shared, verdict); });
}

void BssMac::end(const Waiting& waiting, hal::Verdict verdict) {
  if (waiting.source == agent()) return report(waiting.request, verdict);
  observer().on_request_end(now(), agent(), waiting.request.destination, verdict);
  if (verdict != hal::Verdict::kDelivered) {
    observer().on_relay_lost(now(), waiting.source, waiting.request, verdict);
  }
  observer().on_msdu_end(now(), {agent(), waiting.source, waiting.request},
                         {.verdict = verdict, .went_over_wire = waiting.over_wire});
}

}  // namespace sim::radio
