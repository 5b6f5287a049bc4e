#include "sim/radio/mac/mobility_framework_mac.h"

#include <algorithm>
#include <utility>

#include "sim/radio/mac/frame_lengths.h"

namespace sim::radio {
namespace {

/// The framework's timeouts and its own ACKs end slightly after the frame, so that events at the
/// frame's end come first.
constexpr hal::Duration kDelta{1};

/// More would overflow 64 bits; every contention window reaches its limit long before.
constexpr std::uint32_t kMostDoublings = 20;

}  // namespace

MobilityFrameworkMac::MobilityFrameworkMac(const Context& context,
                                           const MobilityFrameworkConfig& config, Radio& radio,
                                           hal::RandomStream backoff)
    : MacBase(context),
      config_(config),
      radio_(radio),
      frames_(context.lengths, context.modes, context.agent),
      random_(backoff),
      difs_(config.contention.sifs + 2 * config.contention.slot),
      eifs_(config.contention.sifs + difs_ + airtime_of(FrameType::kAck)),
      queue_(config.contention.queue_limit) {
  radio_.attach(*this);
}

template <class F>
void MobilityFrameworkMac::start(Timer& timer, hal::Duration delay, F&& handler) {
  stop(timer);
  timer.due = now() + delay;
  timer.event = events().schedule(timer.due, Rank::kRadio, agent(), std::forward<F>(handler));
}

void MobilityFrameworkMac::transmit(const MacRequest& request) {
  check(request);
  if (!radio_on()) return report_later(request, hal::Verdict::kRadioOff);
  if (queue_.is_full()) return report_later(request, hal::Verdict::kQueueFull);
  queue_.push(request, now());
  // A packet that finds the station idle waits for DIFS only.
  if (state_ == State::kIdle && !is_running(sifs_)) contend(true);
}

void MobilityFrameworkMac::set_radio(bool on) {
  if (on == radio_on()) return;
  radio_.set_on(on);
  if (on) return;
  for (Timer* timer : {&contention_, &sifs_, &timeout_, &nav_, &busy_}) stop(*timer);
  answer_.reset();
  state_ = State::kIdle;
  attempt_ = 1;
  backoff_left_ = {};
  for (Outgoing& outgoing : queue_.take_all()) {
    report_later(std::move(outgoing.request), hal::Verdict::kRadioOff);
  }
}

void MobilityFrameworkMac::next_cycle() {
  const bool give_up = attempt_ > config_.contention.short_retry_limit;
  MacRequest dropped;
  if (give_up) dropped = pop();
  if (queue_.is_empty()) {
    state_ = State::kIdle;
  } else {
    contend(false);
  }
  if (give_up) report(dropped, hal::Verdict::kRetryLimit);
}

void MobilityFrameworkMac::contend(bool without_backoff) {
  state_ = State::kContend;
  if (radio_.state() != Radio::State::kIdle) return;  // on_medium_idle() continues
  contending_since_ = now();
  start(contention_, difs_ + (without_backoff ? hal::Duration{} : backoff()),
        [this] { on_contention_won(); });
}

/// The rest of an interrupted backoff, or a new one.
hal::Duration MobilityFrameworkMac::backoff() {
  if (backoff_left_ > hal::Duration{}) return backoff_left_;
  const std::uint32_t doublings = std::min(attempt_ - 1, kMostDoublings);
  const std::uint64_t grown = ((config_.contention.cw_min + std::uint64_t{1}) << doublings) - 1;
  const bool broadcast = queue_.head().is_broadcast();
  const auto window = static_cast<std::uint32_t>(
      broadcast ? config_.cw_broadcast : std::min<std::uint64_t>(grown, config_.contention.cw_max));
  backoff_left_ = random_.below(window + 1) * config_.contention.slot;
  return backoff_left_;
}

void MobilityFrameworkMac::on_contention_won() {
  backoff_left_ = {};
  const MacRequest& request = queue_.head().request;
  if (queue_.head().is_broadcast()) {
    state_ = State::kBusy;
    radio_.transmit(ppdu_of(make_data()));
    return;
  }
  const FrameType reply = uses_rts(request) ? FrameType::kCts : FrameType::kAck;
  const FramePtr frame = uses_rts(request) ? make_rts() : make_data();
  ++attempt_;
  send_and_wait(frame, uses_rts(request) ? State::kWaitCts : State::kWaitAck, airtime_of(reply));
}

/// @param reply  airtime of the frame that must have been received by the timeout.
void MobilityFrameworkMac::send_and_wait(const FramePtr& frame, State next, hal::Duration reply) {
  state_ = next;
  radio_.transmit(ppdu_of(frame));
  start(timeout_, frame->airtime + config_.contention.sifs + reply + kDelta,
        [this] { on_timeout(); });
}

void MobilityFrameworkMac::on_timeout() {
  if (state_ != State::kQuiet) next_cycle();
}

void MobilityFrameworkMac::on_medium_busy() {
  if (can_stop(contention_)) {
    if (now() - contending_since_ >= difs_) backoff_left_ = contention_.due - now();
    stop(contention_);
  }
  if (can_stop(sifs_)) {
    stop(sifs_);
    state_ = queue_.is_empty() ? State::kIdle : State::kContend;
  }
}

void MobilityFrameworkMac::on_medium_idle() {
  if (state_ == State::kContend && !is_running(contention_) && !is_running(sifs_)) next_cycle();
}

void MobilityFrameworkMac::on_receive(const ReceivedPpdu& received) {
  const Frame& frame = received.ppdu.first();
  const hal::Dbm rssi = received.rssi;
  const hal::Decibels snr = received.snr;
  if (frame.is_broadcast()) {
    if (state_ == State::kContend) next_cycle();
    return hand_up(frame, rssi, snr);
  }
  if (frame.receiver != agent()) return on_overheard(frame);
  switch (frame.type) {
    case FrameType::kRts:
      return on_rts(frame);
    case FrameType::kCts:
      return on_cts(frame);
    case FrameType::kData:
      return on_data(frame, rssi, snr);
    case FrameType::kAck:
      return on_ack();
    default:
      return;  // this profile has no management frames
  }
}

void MobilityFrameworkMac::on_rts(const Frame& frame) {
  if (state_ != State::kIdle && state_ != State::kContend) return;
  stop(contention_);
  data_due_ = frame.duration - airtime_of(FrameType::kAck) - 2 * config_.contention.sifs + kDelta;
  answer(frames_.cts(frame, config_.contention.sifs));
}

void MobilityFrameworkMac::on_cts(const Frame&) {
  if (state_ != State::kWaitCts) return;
  stop(timeout_);
  answer(make_data());
}

void MobilityFrameworkMac::on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) {
  const bool expected =
      state_ == State::kIdle || state_ == State::kContend || state_ == State::kWaitData;
  if (!expected) return;
  stop(timeout_);
  stop(contention_);
  answer(frames_.ack(frame));
  hand_up(frame, rssi, snr);
}

void MobilityFrameworkMac::on_ack() {
  if (state_ != State::kWaitAck) return;
  stop(timeout_);
  learn_service_time(now() - queue_.head_since());
  const MacRequest done = pop();
  next_cycle();
  report(done, hal::Verdict::kDelivered);
}

void MobilityFrameworkMac::on_overheard(const Frame& frame) {
  if (frame.duration > hal::Duration{}) {
    keep_quiet(frame.duration);
  } else if (frame.type != FrameType::kRts && state_ == State::kContend) {
    next_cycle();
  }
}

void MobilityFrameworkMac::on_receive_error(ReceiveError error) {
  if (error != ReceiveError::kCollision) {
    keep_quiet(eifs_);
  } else if (state_ == State::kContend) {
    next_cycle();
  }
}

void MobilityFrameworkMac::keep_quiet(hal::Duration duration) {
  for (Timer* timer : {&contention_, &sifs_, &timeout_}) stop(*timer);
  state_ = State::kQuiet;
  if (is_running(nav_) && nav_.due >= now() + duration) return;
  start(nav_, duration, [this] { next_cycle(); });
}

void MobilityFrameworkMac::answer(FramePtr frame) {
  answer_ = std::move(frame);
  start(sifs_, config_.contention.sifs, [this] { send_answer(); });
}

void MobilityFrameworkMac::send_answer() {
  const FramePtr frame = std::exchange(answer_, nullptr);
  if (frame->type == FrameType::kData) {
    return send_and_wait(frame, State::kWaitAck, airtime_of(FrameType::kAck));
  }
  const bool is_cts = frame->type == FrameType::kCts;
  state_ = is_cts ? State::kWaitData : State::kBusy;
  radio_.transmit(ppdu_of(frame));
  if (is_cts) start(timeout_, data_due_, [this] { on_timeout(); });
}

void MobilityFrameworkMac::on_transmit_end(const Ppdu& ppdu) {
  const Frame& frame = ppdu.first();
  if (frame.type == FrameType::kAck) {
    start(busy_, kDelta, [this] { next_cycle(); });
  } else if (frame.is_broadcast()) {
    const MacRequest done = pop();
    next_cycle();
    report(done, hal::Verdict::kDelivered);
  }
}

MacRequest MobilityFrameworkMac::pop() {
  attempt_ = 1;
  return queue_.pop(now());
}

bool MobilityFrameworkMac::uses_rts(const MacRequest& request) const {
  const std::uint32_t bits = mpdu_bits(lengths(), FrameType::kData, request.payload->size());
  return bits > 8 * config_.contention.rts_threshold;
}

FramePtr MobilityFrameworkMac::make_rts() {
  const MacRequest& request = queue_.head().request;
  return frames_.rts(request.destination,
                     3 * config_.contention.sifs + airtime_of(FrameType::kCts) +
                         frames_.data_airtime(request) + airtime_of(FrameType::kAck));
}

FramePtr MobilityFrameworkMac::make_data() {
  Outgoing& head = queue_.head();
  const bool after_rts = !head.is_broadcast() && uses_rts(head.request);
  const hal::Duration follows =
      after_rts ? config_.contention.sifs + airtime_of(FrameType::kAck) : hal::Duration{};
  const bool retry = head.attempts++ > 0;
  return frames_.data(head.request,
                      {.sequence = head.sequence, .retry = retry, .duration = follows});
}

}  // namespace sim::radio
