// What an originator sends next; originator_results.cpp has what follows from the answer.
#include "sim/radio/mac/originator.h"

#include <algorithm>

#include "sim/radio/mac/access_category.h"
#include "sim/radio/mac/frame_lengths.h"

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
}

ContentionFunction Originator::function_of(const MacRequest& request) const {
  if (functions_.size() == 1) return 0;
  const bool is_management_frame = is_management(request.header.type);
  return static_cast<ContentionFunction>(is_management_frame ? AccessCategory::kVoice
                                                             : category_of(request.priority));
}

std::size_t Originator::room(ContentionFunction function) const {
  const Function& one = functions_[function];
  std::size_t taken = 0;
  for (const MpduStream* const stream : one.streams) taken += stream->in_flight.size();
  return one.queue.room() - std::min(one.queue.room(), taken);
}

std::size_t Originator::waiting() const {
  std::size_t waiting = 0;
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
  return !one.queue.is_empty() || !one.streams.empty();
}

bool Originator::is_expired(const Outgoing& outgoing, hal::Time now) const {
  return config_.msdu_lifetime && !outgoing.is_management() &&
         now - outgoing.queued > *config_.msdu_lifetime;
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
  if (!function.streams.empty()) {
    MpduStream& stream = *function.streams.front();
    discard_expired(stream, now, ended);
    if (stream.must_ask) return request_exchange(number, stream, now);
    if (!stream.in_flight.empty()) return stream_exchange(number, stream, now, budget);
    settle(function, stream);
  }
  discard_expired(function, now, ended);
  if (function.queue.is_empty()) return std::nullopt;
  if (!is_stream(function.queue.head())) return head_exchange(number, now, budget);
  MpduStream& stream = stream_of(function.queue.head());
  if (request_agreement(stream, function, now)) return head_exchange(number, now, budget);
  stream.served_since = function.queue.head_since();
  function.streams.push_back(&stream);
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
  const std::uint32_t attempt = stream.in_flight.empty() ? 0 : stream.in_flight.front().attempts;
  Exchange exchange{.kind = Exchange::Kind::kAggregate,
                    .function = number,
                    .to = stream.to,
                    .mode = &rates_->mode(stream.to, attempt, now),
                    .stream = &stream,
                    .mpdus = 2};  // so that there is time for a BlockAck
  const hal::Duration after = config_.contention.sifs + response_airtime(exchange);
  const PsduSize size = aggregation_.fill(
      stream, function.queue,
      {*exchange.mode, std::min(exchange.mode->longest_ppdu(), budget.left - after),
       budget.is_first},
      now);
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
  const PhyMode& mode = modes_.response_to(rates_->reliable_mode(stream.to, now));
  return {.kind = Exchange::Kind::kBlockAckRequest,
          .function = number,
          .to = stream.to,
          .mode = &mode,
          .bits = mpdu_bits(lengths_, FrameType::kBlockAckRequest),
          .stream = &stream};
}

PpduPtr Originator::make(const Exchange& exchange, hal::Duration after, hal::Time now) {
  switch (exchange.kind) {
    case Exchange::Kind::kHead:
      return make_head(exchange, after, now);
    case Exchange::Kind::kAggregate:
      return make_mpdus(exchange, after, now);
    case Exchange::Kind::kBlockAckRequest:
      break;
  }
  const BlockAckFields fields{.tid = exchange.stream->tid, .start = exchange.stream->start()};
  return ppdu_of(frames_.block_ack_request(exchange.to, fields, after, *exchange.mode));
}

PpduPtr Originator::make_head(const Exchange& exchange, hal::Duration after, hal::Time now) {
  Outgoing& head = functions_[exchange.function].queue.head();
  const bool retry = head.attempts++ > 0;
  return ppdu_of(frames_.data(head.request, {.sequence = head.sequence,
                                             .retry = retry,
                                             .duration = after,
                                             .mode = exchange.mode,
                                             .at = now}));
}

PpduPtr Originator::make_mpdus(const Exchange& exchange, hal::Duration after, hal::Time now) {
  std::deque<Mpdu>& mpdus = exchange.stream->in_flight;
  if (exchange.mpdus == 1) {
    auto single = std::make_shared<Ppdu>(*exchange.mode, exchange.bits);
    std::shared_ptr<Frame> frame = make_mpdu(exchange, mpdus.front(), after, now);
    frame->airtime = single->airtime;
    single->parts.push_back({std::move(frame), 0, exchange.bits});
    return single;
  }
  ++ampdus_;
  auto ppdu = std::make_shared<Ppdu>(*exchange.mode, exchange.bits);
  const hal::Duration head = exchange.mode->preamble_and_header();
  const auto sent_until = [&](std::uint32_t bit) {
    const double share = static_cast<double>(bit) / exchange.bits;
    return head + hal::Duration{static_cast<std::int64_t>(
                      static_cast<double>((ppdu->airtime - head).count()) * share)};
  };
  hal::Duration sent{};
  for (std::uint32_t i = 0, bits = 0; i < exchange.mpdus; ++i) {
    const std::uint32_t begin = Aggregation::subframe_begin(bits);
    bits = Aggregation::with_subframe(bits, mpdus[i].bits);
    std::shared_ptr<Frame> frame = make_mpdu(exchange, mpdus[i], after, now);
    frame->ampdu = ampdus_;
    frame->is_last_of_ampdu = i + 1 == exchange.mpdus;
    frame->airtime = (frame->is_last_of_ampdu ? ppdu->airtime : sent_until(bits)) - sent;
    frame->airtime_before = sent;
    frame->airtime_of_all = ppdu->airtime;
    sent += frame->airtime;
    ppdu->parts.push_back({std::move(frame), begin, bits});
  }
  return ppdu;
}

std::shared_ptr<Frame> Originator::make_mpdu(const Exchange& exchange, Mpdu& mpdu,
                                             hal::Duration after, hal::Time now) {
  const bool retry = mpdu.attempts++ > 0;
  auto frame = frames_.data(mpdu.msdus.front().request, {.sequence = mpdu.sequence,
                                                         .retry = retry,
                                                         .duration = after,
                                                         .mode = exchange.mode,
                                                         .at = now,
                                                         .qos = true,
                                                         .bits = mpdu.bits});
  if (mpdu.msdus.size() == 1) return frame;
  auto parts = std::make_shared<std::vector<AmsduPart>>();
  for (const Outgoing& msdu : mpdu.msdus) {
    const MacRequest& request = msdu.request;
    parts->push_back({.source = request.header.ds == Ds::kFrom ? request.header.address3 : agent_,
                      .destination = request.header.ds == Ds::kTo ? request.header.address3
                                                                  : request.destination,
                      .ethertype = request.ethertype,
                      .payload = request.payload,
                      .tag = request.tag});
  }
  frame->amsdu = std::move(parts);
  return frame;
}

EndedMsdus Originator::take_all() {
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
  for (auto& [key, stream] : streams_) forget_agreement(stream);
  return ended;
}

}  // namespace sim::radio
