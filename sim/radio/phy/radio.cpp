#include "sim/radio/phy/radio.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "hal/types/check.h"
#include "hal/types/math.h"
#include "hal/types/prefetch.h"
#include "sim/radio/channel/channel.h"
#include "sim/radio/channel/random_loss.h"
#include "sim/radio/phy/known_results.h"

namespace sim::radio {
namespace {

hal::Decibels to_decibels(double ratio) {
  static thread_local KnownResults<std::monostate, 8> logarithms;
  return hal::Decibels{10 * logarithms.of(ratio, {}, hal::math::log10)};
}

}  // namespace

Radio::Radio(Air air, StationIndex index, hal::AgentId agent, hal::RandomStream errors)
    : events_(air.events),
      channel_(air.channel),
      observer_(air.observer),
      rules_(air.rules),
      index_(index),
      agent_(agent),
      known_(air.known),
      knows_all_(air.known == Capabilities{}),
      loss_(air.loss),
      errors_(errors),
      cca_threshold_(to_milliwatts(air.config.cca_threshold).value),
      energy_detection_(to_milliwatts(air.config.energy_detection).value),
      capture_window_(air.config.capture_window),
      preamble_window_(air.config.preamble_window),
      forgets_overlap_(air.config.header_error == HeaderError::kForgotten),
      state_(air.events, State::kIdle) {
  if (air.config.capture_margin) {
    capture_margin_ = hal::math::pow(10, air.config.capture_margin->value / 10);
  }
}

void Radio::prefetch() const { hal::prefetch(this, sizeof *this); }

void Radio::prefetch_listener() const {
  // Approximate extent of what a MAC needs for each frame, before and after its RadioListener.
  constexpr std::ptrdiff_t kBefore = 128;
  constexpr std::size_t kMac = 640;
  hal::prefetch(reinterpret_cast<const char*>(listener_) - kBefore, kBefore + kMac);
  hal::prefetch(signals_.data(), sizeof(Signal));
}

void Radio::prefetch_links() const { channel_.prefetch_links(index_); }

void Radio::transmit(PpduPtr ppdu) {
  settle();
  BARAKA_CHECK(state_ == State::kIdle || state_ == State::kReceive);
  lose_all(hal::Verdict::kReceiverTransmitting);
  for (Signal& signal : signals_) {
    // Of two frames that start at the same time, neither is the first, whichever is reported first.
    if (signal.start == events_.now()) signal.verdict = hal::Verdict::kReceiverTransmitting;
  }
  state_ = State::kTransmit;
  ignore_energy();
  sending_ = std::move(ppdu);
  sending_until_ = events_.now() + sending_->airtime;
  channel_.transmit(*this, sending_);
}

void Radio::end_transmit(const Ppdu& ppdu) {
  if (sending_.get() != &ppdu) return;
  const PpduPtr sent = std::move(sending_);
  state_ = State::kIdle;
  sense();
  listener_->on_transmit_end(*sent);
  announce();
}

void Radio::set_on(bool on) {
  if (on == (state_ != State::kOff)) return;
  if (on) {
    state_ = State::kIdle;
    sense();
    said_busy_ = state_ == State::kReceive;
    return;
  }
  settle();
  lose_all(hal::Verdict::kRadioOff);
  state_ = State::kOff;
  ignore_energy();
  said_busy_ = false;
  if (sending_) channel_.cut(*this);
  sending_.reset();
}

void Radio::settle() {
  if (state_ == State::kTransmit && sending_until_ == events_.now()) end_transmit(*sending_);
  while (true) {
    const auto over = std::find_if(signals_.begin(), signals_.end(), [this](const Signal& signal) {
      return signal.end == events_.now();
    });
    if (over == signals_.end()) break;
    end_signal(*over->ppdu, false);
  }
  if (window_ && events_.now() - *window_ >= preamble_window_) take_strongest();
}

bool Radio::begin_signal(const Ppdu& ppdu, const Propagation::Arrival& arrival) {
  settle();
  hear();
  const hal::Time now = events_.now();
  signals_.push_back({.ppdu = &ppdu,
                      .arrival = arrival,
                      .start = now,
                      .end = now + ppdu.airtime,
                      .verdict = std::nullopt});
  signals_.back().verdict = refuse(signals_.back());
  if (forgets_overlap_) recall_for(signals_.back());
  const bool had_window = window_.has_value();
  const bool holds_it = !signals_.back().verdict && synchronise(signals_.back());
  sense();
  if (holds_it) listener_->on_receive_start();
  announce();
  return window_.has_value() && !had_window;
}

std::optional<hal::Verdict> Radio::refuse(const Signal& signal) const {
  if (state_ == State::kOff) return hal::Verdict::kRadioOff;
  if (state_ == State::kTransmit) return hal::Verdict::kReceiverTransmitting;
  if (signal.arrival.blocked) return hal::Verdict::kObstacle;
  if (signal.arrival.power.value < rules_.sensitivity) return hal::Verdict::kBelowSensitivity;
  if (is_foreign(*signal.ppdu)) return hal::Verdict::kPreambleMissed;
  return std::nullopt;
}

/// Whether this radio can interpret not even the preamble of a PPDU.
bool Radio::is_foreign(const Ppdu& ppdu) const {
  return !knows_all_ && !known_.hears(ppdu.mode->id());
}

bool Radio::synchronise(Signal& signal) {
  if (held_) {
    if (!can_capture(signal)) {
      signal.verdict = hal::Verdict::kPreambleMissed;
      return false;
    }
    Signal& held = *find(held_->ppdu());
    held.verdict =
        held.start == signal.start ? hal::Verdict::kPreambleMissed : hal::Verdict::kCollision;
  } else if (preamble_window_ > hal::Duration{}) {
    if (!window_) window_ = signal.start;
    return false;
  }
  hold(signal);
  return true;
}

bool Radio::can_capture(const Signal& signal) const {
  // Of frames that start at the same time neither is the first: the stronger one is received, not
  // the one whose transmitter has the lower address.
  if (held_->start() == signal.start) {
    return signal.arrival.power.value > held_->power();
  }
  return capture_margin_ && events_.now() - held_->locked() <= capture_window_ &&
         signal.arrival.power.value >= *capture_margin_ * held_->power();
}

void Radio::take_strongest() {
  Signal* const best = strongest_in_window();
  window_.reset();
  if (best == nullptr) return;
  Interference others = interference(*best->ppdu);
  faint().add_lasting_to(others, events_.now());
  if (best->arrival.power.value < rules_.min_sinr * (rules_.noise + others.sum)) {
    best->verdict = cause_of_loss(rules_, others);
    return;
  }
  hold(*best);
  sense();
  listener_->on_receive_start();
  announce();
}

Radio::Signal* Radio::strongest_in_window() {
  Signal* best = nullptr;
  for (Signal& signal : signals_) {
    if (signal.verdict) continue;
    if (best == nullptr || signal.arrival.power > best->arrival.power) best = &signal;
  }
  for (Signal& signal : signals_) {
    if (!signal.verdict && &signal != best) signal.verdict = hal::Verdict::kCollision;
  }
  return best;
}

void Radio::hold(const Signal& signal) {
  held_.emplace(*signal.ppdu, signal.arrival.power.value, signal.start, events_.now());
  faint().keep_from(events_.now());
  // A frame sensed by its power keeps the medium busy until its end; any other only while it is
  // held.
  if (signal.arrival.power.value >= cca_threshold_ && !forgets_overlap_) return;
  header_look_ = events_.schedule(held_->header_end(), Rank::kRadio, agent_, [this] { hear(); });
}

void Radio::release() {
  events_.cancel(header_look_);
  held_.reset();
  faint().keep_nothing();
}

void Radio::lose_all(hal::Verdict verdict) {
  for (Signal& signal : signals_) {
    if (!signal.verdict) signal.verdict = verdict;
  }
  release();
  window_.reset();
}

void Radio::end_signal(const Ppdu& ppdu, bool cut) {
  const Signal* const found = find(ppdu);
  if (found == nullptr) return;
  hear();
  const Signal signal = *found;
  signals_.erase(signals_.begin() + (found - signals_.data()));
  const bool was_held = held_ && &held_->ppdu() == &ppdu;
  ReceiveError error = ReceiveError::kBitError;
  hal::Decibels snr;
  Verdicts verdicts;
  for (std::size_t i = 0; i < ppdu.parts.size(); ++i) {
    verdicts.push_back(signal.verdict.value_or(hal::Verdict::kPreambleMissed));
  }
  if (was_held) {
    error = judge_held(verdicts);
    snr = to_decibels(held_->min_sinr());
    release();
    recall_all();
  }
  if (cut || loss_ != nullptr) strike(signal, cut, verdicts);
  sense();
  report(signal, verdicts, was_held ? std::optional(snr) : std::nullopt);
  const bool some = std::ranges::find(verdicts, hal::Verdict::kDelivered) != verdicts.end();
  if (was_held && some) {
    const std::span all(verdicts.data(), verdicts.size());
    listener_->on_receive({ppdu, all, signal.arrival.level, snr});
  } else if (was_held) {
    listener_->on_receive_error(error);
  }
  announce();
}

/// Decides the verdict of each MPDU of the held PPDU. @return the error if none was received.
ReceiveError Radio::judge_held(Verdicts& verdicts) {
  ReceiveError error = ReceiveError::kBitError;
  if (!knows_all_ && !known_.supports(held_->ppdu().mode->id())) {
    // An older receiver takes the signal field for that of its own class, and the FCS is wrong.
    std::ranges::fill(verdicts, hal::Verdict::kPreambleMissed);
    return error;
  }
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Reception::Outcome outcome = held_->judge(i, rules_, errors_);
    verdicts[i] = outcome.verdict;
    error = outcome.error;
  }
  return error;
}

/// Applies random loss, and what a cut does to MPDUs whose verdict was open.
void Radio::strike(const Signal& signal, bool cut, Verdicts& verdicts) const {
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    hal::Verdict& verdict = verdicts[i];
    if (verdict == hal::Verdict::kDelivered && loss_ != nullptr &&
        loss_->strikes(*signal.ppdu->parts[i].frame, agent_)) {
      verdict = hal::Verdict::kRandomLoss;
    }
    if (cut && !signal.verdict) verdict = hal::Verdict::kRadioOff;
  }
}

/// @param snr  of a PPDU to which the radio was synchronised.
void Radio::report(const Signal& signal, const Verdicts& verdicts,
                   std::optional<hal::Decibels> snr) {
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (snr) observer_.on_sinr(snr->value);
    observer_.on_reception(events_.now(), *signal.ppdu->parts[i].frame, agent_, verdicts[i],
                           signal.arrival.level.value);
  }
}

Interference Radio::interference(const Ppdu& wanted) const {
  Interference others;
  for (const Signal& signal : signals_) {
    if (signal.ppdu == &wanted) continue;
    double power = signal.arrival.power.value;
    // Of a wider PPDU, the part within the width of the wanted one.
    const double width = wanted.mode->width(), other = signal.ppdu->mode->width();
    if (other > width) power *= width / other;
    others.sum += power;
    others.strongest = std::max(others.strongest, power);
  }
  return others;
}

FaintSignals& Radio::faint() { return channel_.faint_at(index_); }

/// Since the last call, the interference of the signals with events has been constant, but not that
/// of the faint signals.
void Radio::hear() {
  if (!held_) return;
  const hal::Time now = events_.now();
  if (!held_->has_header() && held_->header_end() <= now) {
    hear_until(held_->header_end());
    held_->judge_header(rules_, errors_);
    if (held_->has_wrong_header()) return lose_header();
    last_header_ = held_->header_end();
  }
  hear_until(now);
}

void Radio::hear_until(hal::Time end) {
  const Interference others = interference(held_->ppdu());
  while (held_->heard_until() < end) {
    Interference all = others;
    hal::Time until = end;
    faint().add_to(all, held_->heard_until(), until);
    held_->hear(rules_, all, until);
  }
  faint().keep_from(end);
}

/// Frees the receiver for other frames, because the header of the held frame is wrong.
void Radio::lose_header() {
  find(held_->ppdu())->verdict = held_->judge(0, rules_, errors_).verdict;
  if (forgets_overlap_) forget_overlap();
  release();
  sense();
  listener_->on_receive_error(ReceiveError::kHeader);
  announce();
}

bool Radio::is_receiving() {
  settle();
  hear();
  return held_ && held_->has_header();
}

bool Radio::has_received_since(hal::Time since) {
  settle();
  hear();
  return last_header_ >= since;
}

Radio::Signal* Radio::find(const Ppdu& ppdu) {
  const auto found = std::find_if(signals_.begin(), signals_.end(),
                                  [&ppdu](const Signal& signal) { return signal.ppdu == &ppdu; });
  return found == signals_.end() ? nullptr : &*found;
}

}  // namespace sim::radio
