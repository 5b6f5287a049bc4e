#pragma once

#include <array>
#include <cstddef>

#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/phy/radio_use.h"

namespace sim::radio {

/// A state that counts how long it has had each of its values since time 0 and reports each change
/// to one listener. It is read and assigned like the plain value.
/// @tparam State  an enumeration of kStates values from 0 on, with
/// `RadioActivity activity_of(State)`.
template <class State, std::size_t kStates>
class TimedState {
 public:
  TimedState(const EventQueue& events, State first) : events_(events), state_(first) {}

  /// Sets the listener and reports the current state to it. @param listener  null: none.
  void tell(RadioUseListener* listener) {
    listener_ = listener;
    if (listener_ != nullptr) listener_->on_activity(activity_of(state_));
  }

  TimedState& operator=(State next) {
    if (next == state_) return *this;
    const hal::Time now = events_.now();
    spent_[static_cast<std::size_t>(state_)] += now - since_;
    since_ = now;
    state_ = next;
    if (listener_ != nullptr) listener_->on_activity(activity_of(next));
    return *this;
  }
  operator State() const { return state_; }  // NOLINT(google-explicit-constructor): as the value

  /// Time spent in a state up to now.
  hal::Duration spent(State state) const {
    const hal::Duration before = spent_[static_cast<std::size_t>(state)];
    return state == state_ ? before + (events_.now() - since_) : before;
  }

 private:
  const EventQueue& events_;
  State state_;
  hal::Time since_{};
  RadioUseListener* listener_ = nullptr;
  std::array<hal::Duration, kStates> spent_{};
};

}  // namespace sim::radio
