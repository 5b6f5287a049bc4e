// What an originator sends next; originator_frames.cpp makes the frames, originator_turns.cpp has
// the queues of receivers, originator_results.cpp what follows from the answer.
#include "sim/radio/mac/originator.h"

#include <algorithm>
#include <functional>

#include "sim/radio/mac/access_category.h"
#include "sim/radio/mac/frame_lengths.h"
#include "sim/radio/mac/lifetime.h"

namespace sim::radio {
namespace {

using namespace std::chrono_literals;

/// How long an originator waits for an answer to its request for an agreement.
constexpr hal::Duration kAgreementTimeout = 200ms;

}  // namespace

Originator::Originator(const Parts& parts, FrameFactory& frames)
    : config_(parts.config),
      modes_(parts.modes),
      lengths_(parts.lengths),
      cell_(parts.cell),
      agent_(parts.agent),
      frames_(frames),
      ladders_(make_ladder(parts.config, parts.modes), parts.cell),
      rates_(make_rate_control(parts.config.rate_control, ladders_, parts.rates)),
      protection_(parts.config, parts.modes, parts.cell),
      aggregation_(parts.config) {
  const ContentionConfig& contention = config_.contention;
  for (std::size_t i = 0; i < parts.functions; ++i) {
    functions_.push_back({TxQueue(contention.queue_limit),
                          RetryCounters(contention.short_retry_limit, config_.long_retry_limit)});
  }
  if (config_.queues.per == QueuePer::kStation) {
    queues_ = std::make_unique<MsduQueues>(
        config_, parts.functions, MsduQueues::Station{parts.observer, parts.agent, parts.flows});
  }
}

ContentionFunction Originator::function_of(const MacRequest& request) const {
  if (functions_.size() == 1) return 0;
  const bool is_management_frame = is_management(request.header.type);
  return static_cast<ContentionFunction>(is_management_frame ? AccessCategory::kVoice
                                                             : category_of(request.priority));
}

std::size_t Originator::room(ContentionFunction function) const {
  if (queues_ != nullptr) return queues_->room(function);
  const Function& one = functions_[function];
  std::size_t taken = 0;
  for (const MpduStream* const stream : one.streams) taken += stream->in_flight.size();
  return one.queue.room() - std::min(one.queue.room(), taken);
}

std::size_t Originator::waiting() const {
  std::size_t waiting = queues_ == nullptr ? 0 : queues_->waiting_with_back();
  for (const Function& one : functions_) {
    waiting += one.queue.size();
    for (const MpduStream* const stream : one.streams) {
      for (const Mpdu& mpdu : stream->in_flight) waiting += mpdu.msdus.size();
    }
  }
  return waiting;
}

void Originator::push(const MacRequest& request, hal::Time now) {
  functions_[function_of(request)].queue.push(request, now);
}

void Originator::push_front(const MacRequest& request, hal::Time now) {
  functions_[function_of(request)].queue.push_front(request, now);
}

bool Originator::has_work(ContentionFunction function) const {
  const Function& one = functions_[function];
  return !one.queue.is_empty() || !one.streams.empty() ||
         (queues_ != nullptr && queues_->has(function));
}

bool Originator::is_expired(const Outgoing& outgoing, hal::Time now) const {
  const std::optional<hal::Duration> lifetime = lifetime_of(config_, outgoing.request.priority);
  return lifetime && !outgoing.is_management() && now - outgoing.queued > *lifetime;
}

void Originator::discard_expired(Function& function, hal::Time now, EndedMsdus& ended) {
  while (!function.queue.is_empty() && is_expired(function.queue.head(), now)) {
    function.retries.reset();
    ended.push_back({function.queue.pop(now), hal::Verdict::kExpired});
  }
}

/// Whether a request is unicast data with the QoS header, which older stations do not know.
bool Originator::is_stream(const Outgoing& outgoing) const {
  if (!config_.qos || outgoing.is_broadcast() || outgoing.is_management()) return false;
  return !has_streams(modes_.data().modulation_class()) ||
         cell_.capabilities(outgoing.request.destination).supports(ModulationClass::kHt);
}

MpduStream& Originator::stream_of(const Outgoing& outgoing) {
  const hal::AgentId to = outgoing.request.destination;
  const std::uint8_t tid = outgoing.request.priority;
  const auto [place, is_new] = streams_.try_emplace({to, tid});
  if (is_new) {
    place->second.to = to;
    place->second.tid = tid;
  }
  return place->second;
}

/// Asks the receiver for an agreement if it is time. @return whether the request is to be sent now.
bool Originator::request_agreement(MpduStream& stream, Function& function, hal::Time now) {
  if (config_.aggregation.max_ampdu == 0 || stream.agreement == MpduStream::Agreement::kActive ||
      now < stream.ask_from || !stream.in_flight.empty() ||
      !has_streams(modes_.data().modulation_class())) {
    return false;
  }
  const MacRequest& head = function.queue.head().request;
  const hal::AgentId bssid = head.header.ds == Ds::kTo     ? stream.to
                             : head.header.ds == Ds::kFrom ? agent_
                                                           : hal::AgentId{};
  stream.agreement = MpduStream::Agreement::kRequested;
  stream.ask_from = now + kAgreementTimeout;
  const AddBlockAckRequest request{.dialog_token = ++dialogs_,
                                   .tid = stream.tid,
                                   .window = config_.aggregation.block_ack_window,
                                   .start = stream.next_sequence};
  function.queue.push_front({.destination = stream.to,
                             .priority = stream.tid,
                             .payload = std::make_shared<const hal::Bytes>(encode(request)),
                             .header = {.type = FrameType::kAction, .address3 = bssid}},
                            now);
  return true;
}

std::optional<Exchange> Originator::next(ContentionFunction number, hal::Time now,
                                         const Budget& budget, EndedMsdus& ended) {
  Function& function = functions_[number];
  if (is_in_service(function)) {
    MpduStream& stream = *function.streams.front();
    if (resume(number, stream, now, ended)) return stream_turn(number, stream, now, budget);
  }
  discard_expired(function, now, ended);
  if (!function.queue.is_empty()) return head_turn(number, now, budget);
  return queues_ == nullptr ? std::nullopt : next_turn(number, now, budget, ended);
}

/// Whether the first stream goes on, whatever else waits. What failed is repeated first. With
/// queues of receivers, whose turn it is decides; else the order of arrival: an MPDU that was left
/// over from the last PPDU, because it did not fit, has its place in the queue.
bool Originator::is_in_service(const Function& function) const {
  if (function.streams.empty()) return false;
  const MpduStream& stream = *function.streams.front();
  if (function.retries.is_counting()) return !function.had_head;
  if (stream.must_ask) return true;
  if (queues_ != nullptr) return false;
  if (stream.in_flight.empty() || function.queue.is_empty()) return true;
  const Mpdu& first = stream.in_flight.front();
  const Outgoing& head = function.queue.head();
  if (first.attempts > 0 || Aggregation::belongs(stream, head)) return true;
  return !head.is_management() && first.msdus.front().queued <= head.queued;
}

/// @return whether anything of the stream is left to be sent.
bool Originator::resume(ContentionFunction number, MpduStream& stream, hal::Time now,
                        EndedMsdus& ended) {
  discard_expired(stream, now, ended);
  if (stream.must_ask || !stream.in_flight.empty()) return true;
  settle(functions_[number], stream);
  return false;
}

std::optional<Exchange> Originator::stream_turn(ContentionFunction number, MpduStream& stream,
                                                hal::Time now, const Budget& budget) {
  if (stream.must_ask) return request_exchange(number, stream, now);
  return stream_exchange(number, stream, now, budget);
}

/// The turn of the head of the queue.
std::optional<Exchange> Originator::head_turn(ContentionFunction number, hal::Time now,
                                              const Budget& budget) {
  Function& function = functions_[number];
  if (!is_stream(function.queue.head())) return head_exchange(number, now, budget);
  MpduStream& stream = stream_of(function.queue.head());
  if (request_agreement(stream, function, now)) return head_exchange(number, now, budget);
  stream.served_since = function.queue.head_since();
  std::erase(function.streams, &stream);
  function.streams.push_front(&stream);
  return stream_exchange(number, stream, now, budget);
}

hal::Duration Originator::response_airtime(const Exchange& exchange) const {
  if (exchange.is_group()) return {};
  const PhyMode& response = modes_.response_to(*exchange.mode);
  return exchange.has_block_ack()
             ? response.airtime(block_ack_bits(bitmap_length(exchange.stream->window)))
             : response.airtime(mpdu_bits(lengths_, FrameType::kAck));
}

std::optional<Exchange> Originator::head_exchange(ContentionFunction number, hal::Time now,
                                                  const Budget& budget) {
  functions_[number].had_head = true;
  const Outgoing& head = functions_[number].queue.head();
  const MacRequest& request = head.request;
  Exchange exchange{.function = number, .to = request.destination};
  exchange.mode = has_rate_control(exchange)
                      ? &rates_->mode(request.destination, head.attempts, now)
                      : &frames_.data_mode(request);
  exchange.bits = mpdu_bits(lengths_, request.header.type, request.payload->size());
  exchange.opening = protection_.opening(head.is_broadcast(), *exchange.mode, exchange.bits);
  const hal::Duration needed =
      exchange.mode->airtime(exchange.bits) + config_.contention.sifs + response_airtime(exchange);
  if (!budget.is_first && needed > budget.left) return std::nullopt;
  return exchange;
}

std::optional<Exchange> Originator::stream_exchange(ContentionFunction number, MpduStream& stream,
                                                    hal::Time now, const Budget& budget) {
  Function& function = functions_[number];
  function.had_head = false;
  const std::uint32_t attempt = stream.in_flight.empty() ? 0 : stream.in_flight.front().attempts;
  Exchange exchange{.kind = Exchange::Kind::kAggregate,
                    .function = number,
                    .to = stream.to,
                    .mode = &rates_->mode(stream.to, attempt, now),
                    .stream = &stream,
                    .mpdus = 2};  // so that there is time for a BlockAck
  const hal::Duration after = config_.contention.sifs + response_airtime(exchange);
  std::function<bool()> more;
  if (queues_ != nullptr) more = [&] { return pop_more(number, stream, now); };
  const PsduSize size = aggregation_.fill(
      stream, function.queue,
      {*exchange.mode, std::min(exchange.mode->longest_ppdu(), budget.left - after),
       budget.is_first},
      now, more);
  if (queues_ != nullptr) put_back(number, now);
  if (size.mpdus == 0) {
    settle(function, stream);
    return std::nullopt;
  }
  exchange.mpdus = size.mpdus;
  exchange.bits = size.bits;
  exchange.opening = protection_.opening(false, *exchange.mode, size.bits);
  return exchange;
}

Exchange Originator::request_exchange(ContentionFunction number, MpduStream& stream,
                                      hal::Time now) {
  functions_[number].had_head = false;
  const PhyMode& mode = modes_.response_to(rates_->reliable_mode(stream.to, now));
  return {.kind = Exchange::Kind::kBlockAckRequest,
          .function = number,
          .to = stream.to,
          .mode = &mode,
          .bits = mpdu_bits(lengths_, FrameType::kBlockAckRequest),
          .stream = &stream};
}

EndedMsdus Originator::take_all(hal::Time now) {
  EndedMsdus ended;
  for (Function& one : functions_) {
    for (MpduStream* const stream : one.streams) {
      for (Mpdu& mpdu : stream->in_flight) end(mpdu, hal::Verdict::kRadioOff, ended);
      stream->in_flight.clear();
    }
    one.streams.clear();
    for (Outgoing& outgoing : one.queue.take_all()) {
      ended.push_back({std::move(outgoing.request), hal::Verdict::kRadioOff});
    }
    one.retries.reset();
  }
  if (queues_ != nullptr) {
    std::vector<Outgoing> back;
    queues_->clear(now, back);
    for (Outgoing& outgoing : back) {
      ended.push_back({std::move(outgoing.request), hal::Verdict::kRadioOff});
    }
  }
  for (auto& [key, stream] : streams_) forget_agreement(stream);
  return ended;
}

}  // namespace sim::radio
