// The part of Radio that senses the carrier: by the frames that can be received, and by energy.
#include <limits>
#include <utility>

#include "sim/radio/channel.h"
#include "sim/radio/radio.h"

namespace sim::radio {
namespace {

constexpr double kNoAlarm = std::numeric_limits<double>::infinity();

}  // namespace

void Radio::sense() {
  if (state_ == State::kOff || state_ == State::kTransmit) return;
  double sum = 0;
  bool is_busy = held_.has_value();
  for (const Signal& signal : signals_) {
    is_busy |= signal.arrival.power.value >= cca_threshold_ && !is_foreign(*signal.frame);
    sum += signal.arrival.power.value;
  }
  if (is_busy) {
    ignore_energy();
    state_ = State::kReceive;
  } else {
    sense_energy(sum);
  }
}

/// @param sum  mW, of the signals with events.
void Radio::sense_energy(double sum) {
  events_.cancel(energy_look_);
  faint().set_alarm(energy_detection_ - sum);
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

}  // namespace sim::radio
