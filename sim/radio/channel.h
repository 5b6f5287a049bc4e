#pragma once

#include <memory>
#include <vector>

#include "sim/core/event_queue.h"
#include "sim/radio/faint_signals.h"
#include "sim/radio/frame.h"
#include "sim/radio/neighbourhood.h"
#include "sim/radio/observer.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

class Radio;

/// The air: carries each frame to the radios that can notice it and to nobody else. Without
/// propagation delay a frame costs one event at its end, whatever the number of receivers, which
/// are visited in order of their addresses. Where it is faint it costs no event at all.
class Channel {
 public:
  Channel(EventQueue& events, Neighbourhood& neighbourhood, RadioObserver& observer,
          const WavesConfig& config);
  ~Channel();

  /// @pre in order of StationIndex, before anything is sent.
  void add(Radio& radio);

  /// What is too weak for a radio to be told of.
  FaintSignals& faint_at(StationIndex station) { return faint_[station]; }

  /// The frame starts now.
  void transmit(Radio& from, const FramePtr& frame);

  /// What this radio is transmitting ends now, cut short.
  void cut(const Radio& from);

 private:
  struct Transmission;
  using TransmissionPtr = std::shared_ptr<Transmission>;

  void start_faint(const Frame& frame, StationIndex from, const std::vector<FaintLink>& links);
  void start_everywhere(const TransmissionPtr& transmission);
  void start_one_by_one(const TransmissionPtr& transmission);
  void finish(const TransmissionPtr& transmission);
  void arrive(const TransmissionPtr& transmission, std::size_t receiver);

  EventQueue& events_;
  Neighbourhood& neighbourhood_;
  RadioObserver& observer_;
  bool delays_;
  hal::Duration preamble_window_;
  std::vector<Radio*> radios_;
  std::vector<FaintSignals> faint_;       ///< Per receiver.
  std::vector<TransmissionPtr> current_;  ///< Per transmitter.
};

}  // namespace sim::radio
