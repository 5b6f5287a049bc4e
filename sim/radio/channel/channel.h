#pragma once

#include <span>
#include <vector>

#include "sim/core/event_queue.h"
#include "sim/radio/channel/burst.h"
#include "sim/radio/channel/faint_frames.h"
#include "sim/radio/channel/faint_signals.h"
#include "sim/radio/channel/neighbourhood.h"
#include "sim/radio/channel/transmission.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/radio_config.h"

namespace sim::radio {

class Radio;

/// The medium: delivers each frame to the radios that can sense it. Without propagation delay, a
/// frame costs one event, at its end, for any number of receivers, which are visited in order of
/// their addresses. With propagation delay, receivers are visited in order of arrival; in each
/// phase the event of one receiver directly follows that of the previous one without passing
/// through the event queue, unless another event comes between. Receivers at which a frame is faint
/// cost no event.
class Channel {
 public:
  Channel(EventQueue& events, Neighbourhood& neighbourhood, RadioObserver& observer,
          const WavesConfig& config);
  ~Channel();

  /// Adds the next radio. @pre called in order of StationIndex, before anything is sent.
  void add(Radio& radio);

  /// The signals that are too weak to be reported to this station's radio.
  FaintSignals& faint_at(StationIndex station) { return faint_[station]; }

  /// Prefetches the links of a station, which transmit() will need.
  void prefetch_links(StationIndex from) const { neighbourhood_.prefetch_links(from); }

  /// Starts a PPDU now.
  void transmit(Radio& from, const PpduPtr& ppdu);

  /// Starts a burst of energy now; it reaches the station after the delay.
  /// @param length  at most kLongestBurst. @param power  mW
  void interfere(StationIndex at, hal::Duration delay, hal::Duration length, double power);

  /// Cuts the transmission of this radio off now.
  void cut(const Radio& from);

 private:
  using Phase = Transmission::Phase;

  void start_faint(const Ppdu& ppdu, StationIndex from, const Links& links);
  void start_asked(StationIndex receiver);
  void add_faint(const Ppdu& ppdu, StationIndex from, std::span<const FaintLink> links);
  void prefetch(const std::vector<Transmission::Receiver>& receivers, std::size_t now) const;
  void prefetch_first(const std::vector<Transmission::Receiver>& receivers,
                      std::size_t first) const;
  void start_everywhere(Transmission& transmission);
  void start_one_by_one(Transmission& transmission);
  void finish(Transmission& transmission);
  EventQueue::Place place_for(const Radio& radio);
  void follow(Transmission& transmission, Phase phase, std::size_t receiver);
  void schedule(Transmission& transmission, Phase phase);
  void work_off(Transmission& transmission, Phase phase);
  void act(Transmission& transmission, Phase phase, std::size_t receiver);
  void arrive(Transmission& transmission, std::size_t receiver);

  EventQueue& events_;
  Neighbourhood& neighbourhood_;
  RadioObserver& observer_;
  bool delays_;
  hal::Duration preamble_window_;
  std::vector<Radio*> radios_;
  Transmissions transmissions_;
  FaintFrames faint_frames_;
  std::vector<FaintSignals> faint_;     ///< One per receiver.
  std::vector<Transmission*> current_;  ///< One per transmitter; null while it is silent.
};

}  // namespace sim::radio
