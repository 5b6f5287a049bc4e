// The carrier sense of Radio: by frames that can be received, and by energy.
#include <algorithm>
#include <limits>
#include <utility>

#include "sim/radio/channel/channel.h"
#include "sim/radio/phy/radio.h"

namespace sim::radio {
namespace {

constexpr double kNoAlarm = std::numeric_limits<double>::infinity();

}  // namespace

void Radio::sense() {
  if (state_ == State::kOff || state_ == State::kTransmit) return;
  double sum = 0;
  bool is_busy = held_.has_value();
  for (const Signal& signal : signals_) {
    if (signal.is_forgotten) continue;
    is_busy |= signal.arrival.power.value >= cca_threshold_ && !is_foreign(*signal.ppdu);
    sum += signal.arrival.power.value;
  }
  if (is_busy) {
    ignore_energy();
    state_ = State::kReceive;
  } else {
    sense_energy(sum);
  }
}

/// @param sum  total power of the signals with events [mW].
void Radio::sense_energy(double sum) {
  events_.cancel(energy_look_);
  faint().set_alarm(forgotten_ ? 0 : energy_detection_ - sum);
  Interference all{.sum = sum};
  if (sum + faint().bound() >= energy_detection_) {
    hal::Time next = hal::Time::max();
    faint().add_to(all, events_.now(), next);
    if (next != hal::Time::max()) {
      energy_look_ = events_.schedule(next, Rank::kRadio, agent_, [this] { watch_energy(); });
    }
  }
  state_ = all.sum >= energy_detection_ ? State::kReceive : State::kIdle;
}

void Radio::watch_energy() {
  settle();
  recall_for_faint();
  sense();
  announce();
}

void Radio::ignore_energy() {
  faint().set_alarm(kNoAlarm);
  events_.cancel(energy_look_);
}

void Radio::announce() {
  if (state_ == State::kOff || state_ == State::kTransmit) return;
  const bool busy = state_ == State::kReceive;
  if (busy == std::exchange(said_busy_, busy)) return;
  if (busy) {
    listener_->on_medium_busy();
  } else {
    listener_->on_medium_idle();
  }
}

/// HeaderError::kForgotten, after the header of the held frame. At the start of a header, ns-3.37
/// reports the medium busy to its MAC until the header's end, whatever it has reported before.
/// After a wrong header it evaluates the energy again only if the frame lasts longer than the
/// reported time.
void Radio::forget_overlap() {
  const hal::Time header = held_->start() + held_->ppdu().mode->preamble();
  const hal::Time end = held_->start() + held_->ppdu().airtime;
  hal::Time told{};
  for (const Signal& signal : signals_) {
    if (signal.ppdu == &held_->ppdu()) continue;
    if (signal.start >= header && signal.end > told) return recall_all();
    if (signal.start < held_->start()) told = std::max(told, signal.end);
    // Nothing was reported before the preamble was detected.
    if (signal.start >= held_->locked()) told = std::max({told, signal.end, end});
  }
  if (told < end) return recall_all();
  forgotten_ = {events_.now(), told};
  for (Signal& signal : signals_) signal.is_forgotten = true;
}

/// A frame that lasts longer than the forgotten ones, or than the radio's own frame, makes carrier
/// sense evaluate the energy again.
void Radio::recall_for(Signal& next) {
  if (!forgotten_) return;
  const bool is_sending = state_ == State::kTransmit;
  if (next.end > (is_sending ? sending_until_ : forgotten_->until)) return recall_all();
  next.is_forgotten = true;
}

/// The same for a faint frame.
void Radio::recall_for_faint() {
  if (!forgotten_) return;
  const auto [start, end] = faint().newest();
  if (start >= forgotten_->since && end > forgotten_->until) recall_all();
}

void Radio::recall_all() {
  if (!forgotten_) return;
  forgotten_.reset();
  for (Signal& signal : signals_) signal.is_forgotten = false;
}

}  // namespace sim::radio
