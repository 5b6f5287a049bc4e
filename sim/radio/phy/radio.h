#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/random.h"
#include "hal/types/time.h"
#include "sim/core/event_queue.h"
#include "sim/radio/channel/propagation.h"
#include "sim/radio/channel/station_index.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/mac/ppdu.h"
#include "sim/radio/phy/capabilities.h"
#include "sim/radio/phy/radio_use.h"
#include "sim/radio/phy/reception.h"
#include "sim/radio/phy/timed_state.h"

namespace sim::radio {

class Channel;
class FaintSignals;
class RandomLoss;

/// Callbacks from a radio to its MAC. The state and the signals of the radio are up to date when
/// they are called. A callback must not transmit at once, only schedule.
class RadioListener {
 public:
  virtual ~RadioListener() = default;
  /// Carrier sense, while the radio is on and not transmitting.
  virtual void on_medium_busy() = 0;
  virtual void on_medium_idle() = 0;
  /// The receiver synchronised to a frame.
  virtual void on_receive_start() = 0;
  /// A PPDU was received of which at least one MPDU is without error, whether addressed to this
  /// station or not. Called before on_medium_idle().
  virtual void on_receive(const ReceivedPpdu& received) = 0;
  virtual void on_receive_error(ReceiveError error) = 0;
  /// The radio has finished sending its own PPDU.
  virtual void on_transmit_end(const Ppdu& ppdu) = 0;
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
/// Every MPDU of a PPDU reported to the radio ends in exactly one verdict, at the PPDU's end. A
/// signal that ends now is over, in whatever order the events of this time run. PPDUs that are
/// faint here are interference that the radio evaluates when it needs to (FaintSignals). A PPDU
/// with a wrong PHY header is given up at the header's end; that, too, is evaluated on demand.
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
    Capabilities known{};              ///< Frames in other modes are only energy to it.
    const RandomLoss* loss = nullptr;  ///< Null: no random loss.
  };

  Radio(Air air, StationIndex index, hal::AgentId agent, hal::RandomStream errors);

  /// Sets the listener, which outlives the radio. @pre called once, before any other call.
  void attach(RadioListener& listener) { listener_ = &listener; }

  hal::AgentId agent() const { return agent_; }
  StationIndex index() const { return index_; }
  State state() const { return state_; }
  RadioUse use() const {
    return {state_.spent(State::kTransmit), state_.spent(State::kReceive),
            state_.spent(State::kIdle), state_.spent(State::kOff)};
  }
  /// As in MacSap::set_use_listener().
  void set_use_listener(RadioUseListener* listener) { state_.tell(listener); }
  /// Whether the PHY header of a frame has been received and the frame has not ended: between
  /// PHY-RXSTART and PHY-RXEND. May first report to the listener signals that have ended by now.
  bool is_receiving();
  /// Whether a PHY header was received at this time or later: PHY-RXSTART.
  bool has_received_since(hal::Time since);

  /// Starts a PPDU; one that is being received is lost. @pre on, and not transmitting.
  void transmit(PpduPtr ppdu);

  /// Prefetches the links of this station, which transmit() will need.
  void prefetch_links() const;

  /// Switches the radio; off cuts off its own frame. No callbacks.
  void set_on(bool on);

  double energy_detection() const { return energy_detection_; }  ///< mW

  // For the channel.
  /// Prefetch the memory that the next event here needs; call the second when the first has taken
  /// effect.
  void prefetch() const;
  void prefetch_listener() const;
  /// A PPDU begins to arrive. @param ppdu  outlives its signal here.
  /// @return whether a preamble window was opened, which the caller must close after its time.
  bool begin_signal(const Ppdu& ppdu, const Propagation::Arrival& arrival);
  void close_preamble_window() { settle(); }
  /// The faint frames may add up to detectable energy: evaluates the sum at each of their starts
  /// and ends from now on, until it can no longer reach the threshold.
  void watch_energy();
  /// Ends a signal. No effect if it is not present. @param cut  true: before its regular end.
  void end_signal(const Ppdu& ppdu, bool cut);
  /// Ends a transmission. No effect if the radio is no longer transmitting this PPDU.
  void end_transmit(const Ppdu& ppdu);

 private:
  struct Signal {
    const Ppdu* ppdu;
    Propagation::Arrival arrival;
    hal::Time start{};
    hal::Time end{};
    /// Set as soon as the PPDU can no longer be received.
    std::optional<hal::Verdict> verdict;
    bool is_forgotten = false;
  };

  /// Signals that carrier sense ignores: HeaderError::kForgotten.
  struct Forgotten {
    hal::Time since{};
    hal::Time until{};  ///< Until then the medium would be busy.
  };

  void settle();
  void take_strongest();
  std::optional<hal::Verdict> refuse(const Signal& signal) const;
  bool is_foreign(const Ppdu& ppdu) const;
  bool synchronise(Signal& signal);
  bool can_capture(const Signal& signal) const;
  Signal* strongest_in_window();
  void hold(const Signal& signal);
  void lose_all(hal::Verdict verdict);
  Interference interference(const Ppdu& wanted) const;
  FaintSignals& faint();
  void hear();
  void hear_until(hal::Time until);
  void lose_header();
  Signal* find(const Ppdu& ppdu);
  using Verdicts = boost::container::small_vector<hal::Verdict, 1>;  ///< Of the parts of a PPDU.
  ReceiveError judge_held(Verdicts& verdicts);
  void strike(const Signal& signal, bool cut, Verdicts& verdicts) const;
  void report(const Signal& signal, const Verdicts& verdicts, std::optional<hal::Decibels> snr);
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
  Capabilities known_;
  bool knows_all_;
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
  PpduPtr sending_;         ///< While transmitting.
  hal::Time sending_until_{};
  std::vector<Signal> signals_;  ///< In order of arrival.
  std::optional<Reception> held_;
  std::optional<hal::Time> window_;           ///< Start of the open preamble window.
  hal::Time last_header_ = hal::Time::min();  ///< End of the last header that was received.
  std::optional<Forgotten> forgotten_;
  EventQueue::EventId energy_look_;  ///< At the next change of the faint signals.
  /// At the end of the held frame's header, if carrier sense depends on it.
  EventQueue::EventId header_look_;
};

}  // namespace sim::radio
