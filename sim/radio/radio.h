#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/frame.h"
#include "sim/radio/observer.h"
#include "sim/radio/propagation.h"
#include "sim/radio/radio_use.h"
#include "sim/radio/reception.h"
#include "sim/radio/station_index.h"
#include "sim/radio/timed_state.h"

namespace sim::radio {

class Channel;
class FaintSignals;
class RandomLoss;

/// What a radio tells its MAC. State and signals of the radio are up to date when it is called. A
/// handler must not transmit at once, only schedule.
class RadioListener {
 public:
  virtual ~RadioListener() = default;
  /// Carrier sense, while the radio is on and not transmitting.
  virtual void on_medium_busy() = 0;
  virtual void on_medium_idle() = 0;
  /// The receiver synchronised to a frame.
  virtual void on_receive_start() = 0;
  /// A frame came in without error, addressed to this station or not. Before on_medium_idle().
  virtual void on_receive(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) = 0;
  virtual void on_receive_error(ReceiveError error) = 0;
  /// The radio's own frame has left the antenna.
  virtual void on_transmit_end(const Frame& frame) = 0;
};

/// Half-duplex receiver and transmitter of one station.
///
///        own frame starts             own frame ends, medium busy
///   kIdle ------------> kTransmit --------------------> kReceive
///     ^  <------------- medium idle                    |   ^  |
///     |                     ^--- own frame starts -----+   |  |
///     +---------------- last frame gone -------------------|--+
///     +---------------- frame or energy sensed ------------+
///   kOff <---> any: set_on()
///
/// Every frame that the radio is told of ends in exactly one verdict, at the frame's end. What ends
/// now is over, whichever of several events at one time comes first. Frames that are faint here are
/// interference that the radio looks at when it needs to (FaintSignals). A frame whose PHY header
/// is wrong is given up at the header's end; that, too, is looked at when somebody needs to know.
class Radio {
 public:
  enum class State : std::uint8_t { kOff, kIdle, kReceive, kTransmit };
  friend RadioActivity activity_of(State state) {
    switch (state) {
      case State::kOff:
        return RadioActivity::kOff;
      case State::kIdle:
        return RadioActivity::kListening;
      case State::kReceive:
        return RadioActivity::kReceiving;
      case State::kTransmit:
        break;
    }
    return RadioActivity::kTransmitting;
  }

  struct Air {
    EventQueue& events;
    Channel& channel;
    RadioObserver& observer;
    const ReceiverConfig& config;
    const ReceptionRules& rules;
    bool knows_ofdm = true;            ///< Else frames in OFDM are energy to it, and nothing else.
    const RandomLoss* loss = nullptr;  ///< None: only the physics decide.
  };

  Radio(Air air, StationIndex index, hal::AgentId agent, hal::RandomStream errors);

  /// @pre called once, before anything else. The listener outlives the radio.
  void attach(RadioListener& listener) { listener_ = &listener; }

  hal::AgentId agent() const { return agent_; }
  StationIndex index() const { return index_; }
  State state() const { return state_; }
  RadioUse use() const {
    return {state_.spent(State::kTransmit), state_.spent(State::kReceive),
            state_.spent(State::kIdle), state_.spent(State::kOff)};
  }
  /// As MacSap::set_use_listener().
  void set_use_listener(RadioUseListener* listener) { state_.tell(listener); }
  /// The PHY header of a frame has come in, and the frame is still coming: between PHY-RXSTART and
  /// PHY-RXEND. May tell the listener what has ended by now.
  bool is_receiving();
  /// A PHY header has come in at this time or later: PHY-RXSTART.
  bool has_received_since(hal::Time since);

  /// @pre on, and not transmitting. A frame that is coming in is lost.
  void transmit(FramePtr frame);

  /// Off cuts the own frame. No callbacks.
  void set_on(bool on);

  double energy_detection() const { return energy_detection_; }  ///< mW

  // For the channel.
  /// Ask the cache for what the next event here will need. The second: after the first has come.
  void prefetch() const;
  void prefetch_listener() const;
  /// @param frame  outlives its signal here.
  /// @return whether a preamble window opened, which must be closed after its time.
  bool begin_signal(const Frame& frame, const Propagation::Arrival& arrival);
  void close_preamble_window() { settle(); }
  /// The faint frames may add up to energy that is sensed: looks at each of their starts and ends
  /// from now on, until they do not.
  void watch_energy();
  /// Does nothing if the signal is not there any more. @param cut  before its end.
  void end_signal(const Frame& frame, bool cut);
  /// Does nothing if the radio is not transmitting this frame any more.
  void end_transmit(const Frame& frame);

 private:
  struct Signal {
    const Frame* frame;
    Propagation::Arrival arrival;
    hal::Time start{};
    hal::Time end{};
    /// Fixed as soon as it cannot be received any more.
    std::optional<hal::Verdict> verdict;
    bool is_forgotten = false;
  };

  /// What carrier sense does not count any more: HeaderError::kForgotten.
  struct Forgotten {
    hal::Time since{};
    hal::Time until{};  ///< So long the medium would be busy.
  };

  void settle();
  void take_strongest();
  std::optional<hal::Verdict> refuse(const Signal& signal) const;
  bool is_foreign(const Frame& frame) const;
  bool synchronise(Signal& signal);
  bool can_capture(const Signal& signal) const;
  Signal* strongest_in_window();
  void hold(const Signal& signal);
  void lose_all(hal::Verdict verdict);
  Interference interference(const Frame& wanted) const;
  FaintSignals& faint();
  void hear();
  void hear_until(hal::Time until);
  void lose_header();
  Signal* find(const Frame& frame);
  void release();
  void sense();
  void sense_energy(double sum);
  void ignore_energy();
  void announce();
  void forget_overlap();
  void recall_for(Signal& next);
  void recall_for_faint();
  void recall_all();

  EventQueue& events_;
  Channel& channel_;
  RadioObserver& observer_;
  const ReceptionRules& rules_;
  StationIndex index_;
  hal::AgentId agent_;
  bool knows_ofdm_;
  const RandomLoss* loss_;
  hal::RandomStream errors_;
  RadioListener* listener_ = nullptr;

  double cca_threshold_;     ///< mW
  double energy_detection_;  ///< mW
  std::optional<double> capture_margin_;
  hal::Duration capture_window_;
  hal::Duration preamble_window_;
  bool forgets_overlap_;

  TimedState<State, 4> state_;
  bool said_busy_ = false;  ///< What the listener was told last.
  FramePtr sending_;        ///< While transmitting.
  hal::Time sending_until_{};
  std::vector<Signal> signals_;  ///< By arrival.
  std::optional<Reception> held_;
  std::optional<hal::Time> window_;           ///< Start of the open preamble window.
  hal::Time last_header_ = hal::Time::min();  ///< The end of the last one that came in.
  std::optional<Forgotten> forgotten_;
  EventQueue::EventId energy_look_;  ///< At the next change of faint signals.
  EventQueue::EventId header_look_;  ///< At the end of a header that alone is sensed.
};

}  // namespace sim::radio
