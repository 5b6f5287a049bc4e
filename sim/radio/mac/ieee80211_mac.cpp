#include "sim/radio/mac/ieee80211_mac.h"

#include <utility>
#include <variant>

namespace sim::radio {
namespace {

/// Handles the alternatives of a variant.
template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

}  // namespace

Ieee80211Mac::Ieee80211Mac(const Context& context, const DcfConfig& config, Radio& radio,
                           const Streams& streams)
    : MacBase(context),
      config_(config),
      radio_(radio),
      access_(context.events, context.agent, {config, DcfTiming(config, context.modes)},
              streams.backoff, *this),
      carrier_(context.events, radio, access_, config, context.modes),
      sequence_({context.events, radio, carrier_, context.modes}, frames_, originator_, *this),
      frames_(context.lengths, context.modes, context.agent),
      originator_({.config = config,
                   .modes = context.modes,
                   .lengths = context.lengths,
                   .cell = context.cell,
                   .agent = context.agent,
                   .functions = access_.functions(),
                   .rates = streams.rates,
                   .flows = streams.flows,
                   .observer = context.observer},
                  frames_),
      recipient_(context.events, context.agent, config, frames_, *this) {
  radio_.attach(*this);
  if (queues() == nullptr) return;
  own_requests_ = std::make_unique<OwnRequests>(*this);
  queues()->set_client(*own_requests_);
}

void Ieee80211Mac::transmit(const MacRequest& request) {
  check(request);
  if (!radio_on()) return report_later(request, hal::Verdict::kRadioOff);
  radio_.prefetch_links();
  if (queues() != nullptr && !is_management(request.header.type)) {
    if (!queue({request, agent(), now()})) return report_later(request, hal::Verdict::kQueueFull);
    return serve();
  }
  const ContentionFunction function = originator_.function_of(request);
  if (queues() == nullptr && originator_.room(function) == 0)
    return report_later(request, hal::Verdict::kQueueFull);
  originator_.push(request, now());
  ask(function);
}

bool Ieee80211Mac::queue(WaitingMsdu waiting) {
  const MacRequest& request = waiting.request;
  const MsduQueues::Name name{originator_.function_of(request),
                              queues()->client().queue_for(request.destination)};
  return queues()->push(name, std::move(waiting), now());
}

void Ieee80211Mac::serve() {
  for (ContentionFunction function = 0; function < access_.functions(); ++function) ask(function);
}

void Ieee80211Mac::set_radio(bool on) {
  if (on == radio_on()) return;
  radio_.set_on(on);
  sequence_.reset();
  carrier_.reset();
  recipient_.reset();
  EndedMsdus ended = originator_.take_all(now());
  end_all_later(ended);
}

/// Asks for the medium, unless the function has it.
void Ieee80211Mac::ask(ContentionFunction function) {
  const bool has_it = !sequence_.is_idle() && sequence_.exchange().function == function;
  if (!has_it && originator_.has_work(function)) access_.request(function);
}

void Ieee80211Mac::on_access(ContentionFunction function) {
  // Within the CCA time another function of this station has begun to send.
  if (!sequence_.is_idle()) return go_on(function, true);
  const hal::Duration limit = access_.txop_limit(function);
  txop_end_ = now() + limit;
  const bool is_limited = limit > hal::Duration{};
  EndedMsdus expired;
  const std::optional<Exchange> exchange =
      originator_.next(function, now(), {is_limited ? limit : hal::Duration::max(), true}, expired);
  end_all_later(expired);
  if (exchange) sequence_.start(*exchange);
}

void Ieee80211Mac::on_internal_collision(ContentionFunction function) {
  EndedMsdus ended;
  const bool given_up = originator_.on_internal_collision(function, now(), ended);
  go_on(function, given_up);
  end_all_later(ended);
}

/// Starts the next backoff of a function, and asks for the medium if there is something to send.
void Ieee80211Mac::go_on(ContentionFunction function, bool window_starts_anew) {
  if (window_starts_anew) {
    access_.reset_window(function);
  } else {
    access_.grow_window(function);
  }
  access_.draw(function);
  ask(function);
}

void Ieee80211Mac::on_exchange_end(ExchangeEnd end, const BlockAckFields* answer) {
  const Exchange exchange = sequence_.exchange();
  EndedMsdus ended;
  bool window_starts_anew = true;
  const hal::Duration took = now() - originator_.service_since(exchange);
  if (end != ExchangeEnd::kNoCts) originator_.charge(exchange);
  switch (end) {
    case ExchangeEnd::kDelivered:
      originator_.on_delivered(exchange, now(), ended);
      break;
    case ExchangeEnd::kBlockAck:
      originator_.on_block_ack(exchange, *answer, now(), ended);
      break;
    case ExchangeEnd::kNoCts:
    case ExchangeEnd::kNoAnswer:
      window_starts_anew =
          originator_.on_failure(exchange, end == ExchangeEnd::kNoAnswer, now(), ended);
      break;
  }
  const bool is_success = end == ExchangeEnd::kDelivered || end == ExchangeEnd::kBlockAck;
  if (is_success && !ended.empty()) {
    learn_service_time(took / static_cast<std::int64_t>(ended.size()));
  }
  if (!is_success || !continues_txop(exchange)) go_on(exchange.function, window_starts_anew);
  end_all(ended);
}

/// Starts the next exchange in the same TXOP if there is one and it fits.
bool Ieee80211Mac::continues_txop(const Exchange& exchange) {
  const ContentionFunction function = exchange.function;
  if (access_.txop_limit(function) == hal::Duration{}) return false;
  const hal::Duration left = txop_end_ - now() - carrier_.timing().sifs;
  if (left <= hal::Duration{}) return false;
  EndedMsdus expired;
  const std::optional<Exchange> next = originator_.next(function, now(), {left, false}, expired);
  end_all_later(expired);
  if (!next) return false;
  access_.reset_window(function);
  sequence_.start_after_sifs(*next);
  return true;
}

void Ieee80211Mac::end_all(const EndedMsdus& ended) {
  for (const EndedMsdu& one : ended) {
    if (one.request.header.type != FrameType::kAction) report(one.request, one.verdict);
  }
}

void Ieee80211Mac::end_all_later(EndedMsdus& ended) {
  for (EndedMsdu& one : ended) {
    if (one.request.header.type == FrameType::kAction) continue;
    report_later(std::move(one.request), one.verdict);
  }
}

void Ieee80211Mac::on_receive(const ReceivedPpdu& received) {
  // All MPDUs of a PPDU have the same receiver and Duration.
  const Frame& frame = received.ppdu.first();
  carrier_.on_right_frame();
  const bool is_answer = sequence_.is_answer(frame);
  if (!is_answer) sequence_.on_wrong_answer();
  if (frame.receiver == agent()) {
    if (is_answer) {
      if (frame.type != FrameType::kCts) originator_.on_answer(sequence_.exchange(), frame);
      return sequence_.on_answer(frame);
    }
    on_unicast(received);
  } else if (frame.is_broadcast()) {
    hand_up(frame, received.rssi, received.snr);
  } else {
    carrier_.set_nav(frame);
  }
}

void Ieee80211Mac::on_receive_error(ReceiveError error) {
  const bool had_start = error != ReceiveError::kHeader;  // PHY-RXSTART
  if (had_start || config_.receiver.header_error == HeaderError::kEifs) carrier_.begin_eifs();
  // Without PHY-RXSTART the timeout continues.
  if (had_start) sequence_.on_wrong_answer();
}

void Ieee80211Mac::on_unicast(const ReceivedPpdu& received) {
  const Frame& frame = received.ppdu.first();
  if (frame.type == FrameType::kRts) {
    // Another station near this one has reserved the medium: no CTS (10.3.2.9).
    if (!carrier_.is_reserved()) sequence_.answer(frames_.cts(frame, carrier_.timing().sifs));
    return;
  }
  if (frame.type == FrameType::kBlockAckRequest) {
    if (FramePtr answer = recipient_.answer_to_request(frame)) sequence_.answer(std::move(answer));
    return;
  }
  if (is_control(frame.type)) return;
  if (queues() != nullptr) charge_sender(received.ppdu);
  FramePtr answer = recipient_.answer_to(received);
  if (answer == nullptr) return;  // what is not acknowledged will come again
  sequence_.answer(std::move(answer));
  recipient_.accept(received);
}

void Ieee80211Mac::charge_sender(const Ppdu& ppdu) {
  const Frame& frame = ppdu.first();
  MacRequest answer;
  answer.priority = frame.priority;
  const ContentionFunction function = originator_.function_of(answer);
  originator_.charge(frame.transmitter, function, ppdu.airtime);
}

void Ieee80211Mac::on_mpdu(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  if (frame.type == FrameType::kAction) return on_action(frame);
  if (frame.amsdu != nullptr) return on_amsdu(frame, rssi, snr);
  hand_up(frame, rssi, snr);
}

void Ieee80211Mac::on_action(const Frame& frame) {
  const std::optional<BlockAckAction> action = decode_block_ack_action(*frame.payload);
  if (!action) return;
  const hal::AgentId from = frame.transmitter;
  std::visit(Overloaded{[&](const AddBlockAckRequest& one) { recipient_.on_request(frame, one); },
                        [&](const AddBlockAckResponse& one) { originator_.on_response(from, one); },
                        [&](const DeleteBlockAck& one) {
                          if (one.by_originator) return recipient_.on_delete(from, one);
                          originator_.on_delete(from, one);
                        }},
             *action);
}

void Ieee80211Mac::on_amsdu(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  for (const AmsduPart& part : *frame.amsdu) {
    Frame msdu = frame;
    msdu.amsdu = nullptr;
    msdu.ethertype = part.ethertype;
    msdu.payload = part.payload;
    msdu.tag = part.tag;
    if (frame.ds == Ds::kTo) msdu.address3 = part.destination;
    if (frame.ds == Ds::kFrom) msdu.address3 = part.source;
    hand_up(msdu, rssi, snr);
  }
}

void Ieee80211Mac::send_action(const Frame& about, const BlockAckAction& action) {
  const hal::AgentId bssid = about.ds == Ds::kTo     ? about.receiver
                             : about.ds == Ds::kFrom ? about.transmitter
                                                     : about.address3;
  const MacRequest request{.destination = about.transmitter,
                           .payload = std::make_shared<const hal::Bytes>(encode(action)),
                           .header = {.type = FrameType::kAction, .address3 = bssid}};
  originator_.push_front(request, now());
  ask(originator_.function_of(request));
}

}  // namespace sim::radio
