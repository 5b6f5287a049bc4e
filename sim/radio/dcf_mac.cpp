#include "sim/radio/dcf_mac.h"

#include <utility>

#include "sim/radio/frame_lengths.h"

namespace sim::radio {

DcfMac::DcfMac(const Context& context, const DcfConfig& config, Radio& radio,
               hal::RandomStream backoff)
    : MacBase(context),
      config_(config),
      radio_(radio),
      frames_(context.lengths, context.modes, context.agent),
      timing_(config, context.modes),
      backoff_(context.events, context.agent, timing_, backoff, *this),
      window_(config.contention.cw_min, config.contention.cw_max),
      retries_(config.contention.short_retry_limit, config.long_retry_limit),
      queue_(config.contention.queue_limit) {
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
  // EIFS counts from the physical end of the medium's use, whatever the NAV says (10.3.2.3.7).
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

/// 10.3.2.4: no PHY-RXSTART has come since the RTS.
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
  if (queue_.head().is_broadcast()) {
    state_ = State::kBroadcasting;
    return send(make_data());
  }
  state_ = uses_rts() ? State::kWaitCts : State::kWaitAck;
  send(uses_rts() ? make_rts() : make_data());
}

void DcfMac::send(const FramePtr& frame) {
  radio_.transmit(frame);
  update_medium();
}

void DcfMac::on_transmit_end(const Frame& frame) {
  backoff_.hold_until({});
  last_was_wrong_ = false;
  update_medium();
  if (state_ == State::kBroadcasting) return succeed();
  if (frame.type == FrameType::kCts || frame.type == FrameType::kAck) return;
  awaiting_ = true;
  const hal::Duration timeout = timing_.response_timeout(modes().response_to(*frame.mode));
  no_answer_ =
      events().schedule(now() + timeout, Rank::kRadio, agent(), [this] { on_no_answer(); });
}

/// If PHY-RXSTART has come, the frame may be the answer, and its end decides (10.3.2.9).
void DcfMac::on_no_answer() {
  const bool has_begun = radio_.is_receiving();
  if (awaiting_ && !has_begun) fail();
}

void DcfMac::fail() {
  events().cancel(no_answer_);
  awaiting_ = false;
  const bool after_rts = state_ == State::kWaitAck && uses_rts();
  const auto kind = after_rts ? RetryCounters::Kind::kLong : RetryCounters::Kind::kShort;
  state_ = State::kIdle;
  backoff_.restart_idle();
  if (!retries_.fail(kind)) {
    window_.grow();
    backoff_.draw(window_.value());
    return ask_for_medium();
  }
  report(end_service(false), hal::Verdict::kRetryLimit);
}

void DcfMac::succeed() {
  events().cancel(no_answer_);
  awaiting_ = false;
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

bool DcfMac::uses_rts() {
  const MacRequest& request = queue_.head().request;
  return mpdu_bits(lengths(), request.header.type, request.payload->size()) >
         8 * config_.contention.rts_threshold;
}

FramePtr DcfMac::make_rts() {
  const MacRequest& request = queue_.head().request;
  return frames_.rts(request.destination,
                     3 * timing_.sifs +
                         frames_.response_airtime(FrameType::kCts, modes().control()) +
                         frames_.data_airtime(request) +
                         frames_.response_airtime(FrameType::kAck, frames_.data_mode(request)));
}

FramePtr DcfMac::make_data() {
  Outgoing& head = queue_.head();
  const hal::Duration follows =
      head.is_broadcast() ? hal::Duration{}
                          : timing_.sifs + frames_.response_airtime(
                                               FrameType::kAck, frames_.data_mode(head.request));
  const bool retry = std::exchange(head.sent, true);
  return frames_.data(
      head.request, {.sequence = head.sequence, .retry = retry, .duration = follows, .at = now()});
}

void DcfMac::on_receive(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
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
  last_was_wrong_ = true;
  // Without PHY-RXSTART the timeout goes on.
  if (error != ReceiveError::kHeader && awaiting_) fail();
}

void DcfMac::on_unicast(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  switch (frame.type) {
    case FrameType::kRts:
      // Somebody near us has reserved the medium: no answer (10.3.2.7).
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
