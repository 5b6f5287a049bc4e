#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace sim::radio {

struct Frame;          // frame.h
struct MacRequest;     // mac_sap.h
struct MacIndication;  // mac_sap.h

/// A data frame as a station's queue has it: of a client of its own or, in an access point, of
/// another station, to be passed on.
struct Msdu {
  hal::AgentId station;       ///< Where it waits or ended.
  hal::AgentId source;        ///< Who sent it first.
  const MacRequest& request;  ///< To its final destination.
};

/// How that ended there.
struct MsduEnd {
  hal::Verdict verdict = hal::Verdict::kDelivered;  ///< As in MacClient::on_transmitted().
  bool has_waited = true;                           ///< It was in the queue.
  bool went_over_wire = false;                      ///< Delivered: to another access point.
};

/// Observer of the medium, for records and fingerprints. Calls come in event order.
class RadioObserver {
 public:
  virtual ~RadioObserver() = default;
  virtual void on_frame_start(hal::Time at, const Frame& frame) { (void)at, (void)frame; }
  /// After that: at so many radios the frame is above the interference floor and too weak to be
  /// received or sensed. Nothing else is said of it there. Not called if there are none.
  virtual void on_faint(const Frame& frame, std::uint32_t radios) { (void)frame, (void)radios; }
  /// The transmitter breaks off a frame that it began before: its radio is switched off.
  virtual void on_frame_cut(hal::Time at, const Frame& frame) { (void)at, (void)frame; }
  /// Right before on_reception(), if the radio was synchronised to the frame: lowest SINR over it.
  virtual void on_sinr(double sinr_db) { (void)sinr_db; }
  /// Result of a frame at one radio that could receive or sense it by itself, or could without
  /// walls; whether addressed to it or not.
  virtual void on_reception(hal::Time at, const Frame& frame, hal::AgentId receiver,
                            hal::Verdict verdict, double rssi_dbm) {
    (void)at, (void)frame, (void)receiver, (void)verdict, (void)rssi_dbm;
  }
  /// A frame's payload was handed to the station's client: what Fig. 12 of the paper counts.
  virtual void on_delivered(hal::Time at, const Frame& frame, hal::AgentId receiver) {
    (void)at, (void)frame, (void)receiver;
  }
  /// A request ended at its sender.
  virtual void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                              hal::Verdict verdict) {
    (void)at, (void)sender, (void)destination, (void)verdict;
  }
  /// An access point could not pass on what `source` sent; its request has ended before.
  virtual void on_relay_lost(hal::Time at, hal::AgentId source, const MacRequest& request,
                             hal::Verdict verdict) {
    (void)at, (void)source, (void)request, (void)verdict;
  }
  /// An access point queues what another station sent.
  virtual void on_relay_queued(hal::Time at, const Msdu& msdu) { (void)at, (void)msdu; }
  /// What a station was to send, or an access point to pass on, ended there; or came in, and the
  /// station that it is for could not use it. The last frame of it, if any, was seen before, and at
  /// its receiver if it has only one.
  virtual void on_msdu_end(hal::Time at, const Msdu& msdu, const MsduEnd& end) {
    (void)at, (void)msdu, (void)end;
  }
  /// A station is associated with this access point from now on; none: with no one any more.
  virtual void on_association(hal::Time at, hal::AgentId station,
                              std::optional<hal::AgentId> access_point) {
    (void)at, (void)station, (void)access_point;
  }
};

}  // namespace sim::radio
