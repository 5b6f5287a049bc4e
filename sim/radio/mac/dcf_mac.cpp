#include "sim/radio/mac/dcf_mac.h"

#include <utility>

#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {
DcfMac::DcfMac(const Context& context, const DcfConfig& config, Radio& radio,
               const Streams& streams)
    : MacBase(context),
      config_(config),
      radio_(radio),
      frames_(context.lengths, context.modes, context.agent),
      timing_(config, context.modes),
      backoff_(context.events, context.agent, timing_, streams.backoff, *this),
      window_(config.contention.cw_min, config.contention.cw_max),
      retries_(config.contention.short_retry_limit, config.long_retry_limit),
      queue_(config.contention.queue_limit),
      ladders_(make_ladder(config, context.modes), context.cell),
      rates_(make_rate_control(config.rate_control, ladders_, streams.rates)),
      protection_(config, context.modes, context.cell) {
  radio_.attach(*this);
}

void DcfMac::transmit(const MacRequest& request) {
  check(request);
  if (!radio_on()) return report_later(request, hal::Verdict::kRadioOff);
  if (queue_.is_full()) return report_later(request, hal::Verdict::kQueueFull);
  queue_.push(request, now());
  ask_for_medium();
}

void DcfMac::set_radio(bool on) {
  if (on == radio_on()) return;
  radio_.set_on(on);
  for (EventQueue::EventId* event : {&sifs_, &no_answer_, &nav_end_, &nav_reset_}) {
    events().cancel(*event);
  }
  state_ = State::kIdle;
  awaiting_ = false;
  answer_.reset();
  nav_.reset();
  last_was_wrong_ = false;
  window_.reset();
  retries_.reset();
  backoff_.reset(radio_.state() != Radio::State::kIdle);
  for (Outgoing& outgoing : queue_.take_all()) {
    report_later(std::move(outgoing.request), hal::Verdict::kRadioOff);
  }
}

void DcfMac::update_medium() {
  if (radio_.state() != Radio::State::kIdle || nav_.is_set(now())) {
    backoff_.on_busy(window_.value());
  } else {
    backoff_.on_idle();
  }
}

void DcfMac::on_medium_idle() {
  // EIFS is counted from the end of physical carrier sense, whatever the NAV is (10.3.2.3.7).
  if (std::exchange(last_was_wrong_, false)) backoff_.hold_until(now() + timing_.eifs);
  update_medium();
}

void DcfMac::set_nav(const Frame& frame) {
  if (!nav_.extend(now() + frame.duration)) return;
  events().cancel(nav_end_);
  events().cancel(nav_reset_);
  nav_end_ = events().schedule(nav_.until(), Rank::kRadio, agent(), [this] { update_medium(); });
  if (frame.type == FrameType::kRts) {
    const hal::Time since = now();
    nav_reset_ =
        events().schedule(since + timing_.nav_reset(modes().response_to(*frame.mode)), Rank::kRadio,
                          agent(), [this, since] { reset_nav_unless_used(since); });
  }
}

/// 10.3.2.4: resets the NAV if no PHY-RXSTART has followed the RTS.
void DcfMac::reset_nav_unless_used(hal::Time since) {
  if (radio_.has_received_since(since)) return;
  events().cancel(nav_end_);
  nav_.reset();
  update_medium();
}

void DcfMac::ask_for_medium() {
  if (state_ == State::kIdle && !queue_.is_empty()) backoff_.request(window_.value());
}

void DcfMac::on_access() {
  discard_expired();
  if (queue_.is_empty()) return;
  choose_exchange();
  if (opening_ == Opening::kRts) {
    state_ = State::kWaitCts;
    return send(make_rts());
  }
  if (opening_ == Opening::kCtsToSelf) {
    state_ = State::kReserving;
    return send(make_cts_to_self());
  }
  open_exchange();
  send(make_data());
}

/// Enters the state in which the data frame is sent.
void DcfMac::open_exchange() {
  state_ = queue_.head().is_broadcast() ? State::kBroadcasting : State::kWaitAck;
}

/// Whether rate control chooses the mode of the head: unicast data.
bool DcfMac::has_rate_control() {
  return !queue_.head().is_broadcast() && !is_management(queue_.head().request.header.type);
}

void DcfMac::choose_exchange() {
  const Outgoing& head = queue_.head();
  const MacRequest& request = head.request;
  data_mode_ = has_rate_control() ? &rates_->mode(request.destination, head.attempts, now())
                                  : &frames_.data_mode(request);
  opening_ =
      protection_.opening(head.is_broadcast(), *data_mode_,
                          mpdu_bits(lengths(), request.header.type, request.payload->size()));
}

bool DcfMac::is_expired() {
  const Outgoing& head = queue_.head();
  return config_.msdu_lifetime && !is_management(head.request.header.type) &&
         now() - head.queued > *config_.msdu_lifetime;
}

void DcfMac::discard_expired() {
  while (!queue_.is_empty() && is_expired()) {
    retries_.reset();
    report_later(queue_.pop(now()), hal::Verdict::kExpired);
  }
}

void DcfMac::send(const FramePtr& frame) {
  radio_.transmit(ppdu_of(frame));
  update_medium();
}

void DcfMac::on_transmit_end(const Ppdu& ppdu) {
  const Frame& frame = ppdu.first();
  backoff_.hold_until({});
  last_was_wrong_ = false;
  update_medium();
  if (state_ == State::kReserving) {
    open_exchange();
    return answer(make_data());
  }
  if (state_ == State::kBroadcasting) return succeed();
  if (frame.type == FrameType::kCts || frame.type == FrameType::kAck) return;
  awaiting_ = true;
  const hal::Duration timeout = timing_.response_timeout(modes().response_to(*frame.mode));
  no_answer_ =
      events().schedule(now() + timeout, Rank::kRadio, agent(), [this] { on_no_answer(); });
}

/// If there was a PHY-RXSTART, the frame may be the response, and its end decides (10.3.2.9).
void DcfMac::on_no_answer() {
  const bool has_begun = radio_.is_receiving();
  if (awaiting_ && !has_begun) fail();
}

void DcfMac::fail() {
  events().cancel(no_answer_);
  awaiting_ = false;
  const bool was_data = state_ == State::kWaitAck;
  const bool after_rts = was_data && opening_ == Opening::kRts;
  const auto kind = after_rts ? RetryCounters::Kind::kLong : RetryCounters::Kind::kShort;
  // An RTS without a response says nothing about the rate of data.
  if (was_data && has_rate_control()) rates_->on_result(queue_.head().request.destination, false);
  state_ = State::kIdle;
  backoff_.restart_idle();
  const bool is_last = retries_.fail(kind);
  if (!is_last && !is_expired()) {
    window_.grow();
    backoff_.draw(window_.value());
    return ask_for_medium();
  }
  report(end_service(false), is_last ? hal::Verdict::kRetryLimit : hal::Verdict::kExpired);
}

void DcfMac::succeed() {
  events().cancel(no_answer_);
  awaiting_ = false;
  if (state_ == State::kWaitAck && has_rate_control()) {
    rates_->on_result(queue_.head().request.destination, true);
  }
  state_ = State::kIdle;
  report(end_service(true), hal::Verdict::kDelivered);
}

MacRequest DcfMac::end_service(bool count_time) {
  if (count_time) learn_service_time(now() - queue_.head_since());
  MacRequest done = queue_.pop(now());
  window_.reset();
  retries_.reset();
  backoff_.draw(window_.value());
  ask_for_medium();
  return done;
}

/// Duration of SIFS and ACK, if there is an ACK.
hal::Duration DcfMac::after_data() {
  if (queue_.head().is_broadcast()) return {};
  return timing_.sifs + frames_.response_airtime(FrameType::kAck, *data_mode_);
}

hal::Duration DcfMac::data_and_after() {
  return timing_.sifs + frames_.data_airtime(queue_.head().request, *data_mode_) + after_data();
}

FramePtr DcfMac::make_rts() {
  const hal::AgentId to = queue_.head().request.destination;
  const PhyMode& mode = protection_.mode(to, *data_mode_);
  const hal::Duration cts = frames_.response_airtime(FrameType::kCts, mode);
  return frames_.rts(to, timing_.sifs + cts + data_and_after(), mode);
}

FramePtr DcfMac::make_cts_to_self() {
  return frames_.cts_to_self(data_and_after(), protection_.mode(agent(), *data_mode_));
}

FramePtr DcfMac::make_data() {
  Outgoing& head = queue_.head();
  const bool retry = head.attempts++ > 0;
  return frames_.data(head.request, {.sequence = head.sequence,
                                     .retry = retry,
                                     .duration = after_data(),
                                     .mode = data_mode_,
                                     .at = now()});
}

void DcfMac::on_receive(const ReceivedPpdu& received) {
  const Frame& frame = received.ppdu.first();
  const hal::Dbm rssi = received.rssi;
  const hal::Decibels snr = received.snr;
  last_was_wrong_ = false;
  backoff_.hold_until({});
  const bool for_us = frame.receiver == agent();
  const bool awaited = awaiting_ && for_us &&
                       ((state_ == State::kWaitCts && frame.type == FrameType::kCts) ||
                        (state_ == State::kWaitAck && frame.type == FrameType::kAck));
  if (!awaited && awaiting_) fail();
  if (for_us) {
    if (awaited || frame.type == FrameType::kRts || !is_control(frame.type)) {
      on_unicast(frame, rssi, snr);
    }
  } else if (frame.is_broadcast()) {
    hand_up(frame, rssi, snr);
  } else {
    set_nav(frame);
  }
}

void DcfMac::on_receive_error(ReceiveError error) {
  const bool had_start = error != ReceiveError::kHeader;  // PHY-RXSTART
  if (had_start || config_.receiver.header_error == HeaderError::kEifs) begin_eifs();
  // Without PHY-RXSTART the timeout continues.
  if (had_start && awaiting_) fail();
}

void DcfMac::begin_eifs() {
  if (config_.eifs_start == EifsStart::kFrameEnd) {
    backoff_.hold_until(now() + timing_.eifs);
  } else {
    last_was_wrong_ = true;
  }
}

void DcfMac::on_unicast(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  switch (frame.type) {
    case FrameType::kRts:
      // Another station near this one has reserved the medium: no CTS (10.3.2.7).
      if (nav_.is_set(now())) return;
      return answer(frames_.cts(frame, timing_.sifs));
    case FrameType::kCts:
      events().cancel(no_answer_);
      awaiting_ = false;
      retries_.succeed(RetryCounters::Kind::kShort);
      state_ = State::kWaitAck;
      return answer(make_data());
    case FrameType::kAck:
      return succeed();
    default:
      return on_data(frame, rssi, snr);
  }
}

void DcfMac::on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  answer(frames_.ack(frame));
  if (duplicates_.is_duplicate(frame.transmitter, frame.sequence, frame.retry)) return;
  hand_up(frame, rssi, snr);
}

void DcfMac::answer(FramePtr frame) {
  answer_ = std::move(frame);
  events().cancel(sifs_);
  sifs_ = events().schedule(now() + timing_.sifs, Rank::kRadio, agent(),
                            [this] { send(std::exchange(answer_, nullptr)); });
}

}  // namespace sim::radio
