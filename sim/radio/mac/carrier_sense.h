#pragma once

#include "hal/types/agent_id.h"
#include "sim/core/event_queue.h"
#include "sim/radio/mac/channel_access.h"
#include "sim/radio/mac/dcf_timing.h"
#include "sim/radio/mac/frame.h"
#include "sim/radio/mac/nav.h"
#include "sim/radio/phy/mode_set.h"
#include "sim/radio/phy/radio.h"

namespace sim::radio {

/// Carrier sense of one station (IEEE Std 802.11-2020, 10.3.2.1): physical, by the radio; virtual,
/// by the NAV; and the EIFS after erroneous frames. Tells the contention functions whether the
/// medium is busy, which it also is for them during the station's own exchange.
class CarrierSense {
 public:
  /// @param radio,access,config,modes  outlive this object.
  CarrierSense(EventQueue& events, Radio& radio, ChannelAccess& access, const DcfConfig& config,
               const ModeSet& modes);

  const DcfTiming& timing() const { return timing_; }
  /// Whether another station has reserved the medium.
  bool is_reserved() const { return nav_.is_set(events_.now()); }

  /// Call it when the radio's state may have changed.
  void update();
  void on_medium_idle();
  /// The station's own exchange begins.
  void begin_exchange();
  /// It ends. @param is_receiving  the radio is about to report whether the medium is idle.
  void end_exchange(bool is_receiving);
  /// A frame was received or sent: ends an EIFS.
  void on_right_frame();
  void begin_eifs();
  /// Sets the NAV by a frame for another station.
  void set_nav(const Frame& frame);
  /// When the radio is switched.
  void reset();

 private:
  void reset_nav_unless_used(hal::Time since);
  /// End of the EIFS from now on, less the DIFS that follows any busy medium.
  hal::Time eifs_from_now() const { return events_.now() + timing_.eifs - timing_.difs; }

  EventQueue& events_;
  Radio& radio_;
  ChannelAccess& access_;
  EifsStart eifs_start_;
  const ModeSet& modes_;
  DcfTiming timing_;
  Nav nav_;
  bool is_exchanging_ = false;
  bool last_was_wrong_ = false;  ///< The last reception failed: EIFS when the medium is idle.
  EventQueue::EventId nav_end_;
  EventQueue::EventId nav_reset_;
};

}  // namespace sim::radio
