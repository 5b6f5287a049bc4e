#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/edca_config.h"

namespace sim::radio {

struct Frame;          // frame.h
struct MacRequest;     // mac_sap.h
struct MacIndication;  // mac_sap.h

/// A data frame in the queue of a station: a request of its own client or, in an access point, a
/// frame of another station to be relayed.
struct Msdu {
  hal::AgentId station;       ///< Where it waits or ended.
  hal::AgentId source;        ///< Original source.
  const MacRequest& request;  ///< Addressed to the final destination.
};

/// How an MSDU ended at that station.
struct MsduEnd {
  hal::Verdict verdict = hal::Verdict::kDelivered;  ///< As in MacClient::on_transmitted().
  bool has_waited = true;                           ///< The MSDU was in the queue.
  bool went_over_wire = false;  ///< Delivered over the distribution system to another access point.
};

/// What happened in a queue of a station for one receiver and access category
/// (QueuesConfig::per).
struct QueueChange {
  enum class What : std::uint8_t {
    kQueued,
    kLeft,     ///< To be sent, or to take another path.
    kDropped,  ///< After it had been queued; `verdict` says why.
    kRefused,  ///< The queue was full.
  };
  hal::AgentId station;
  /// kEveryone: group frames; of a station with an access point, all, as they go to that.
  hal::AgentId receiver;
  std::optional<AccessCategory> category{};  ///< nullopt: of a station without QoS.
  What what = What::kQueued;
  std::size_t bytes = 0;  ///< Of payload.
  hal::Verdict verdict = hal::Verdict::kDelivered;
};

/// Observer of the medium, for records and fingerprints. Calls come in event order.
class RadioObserver {
 public:
  virtual ~RadioObserver() = default;
  virtual void on_frame_start(hal::Time at, const Frame& frame) { (void)at, (void)frame; }
  /// Follows on_frame_start(): the number of radios at which the frame is above the interference
  /// floor but too weak to be received or sensed. No other call reports the frame at those radios.
  /// Not called if there are none.
  virtual void on_faint(const Frame& frame, std::uint32_t radios) { (void)frame, (void)radios; }
  /// The transmitter cuts off a frame that it began before, because its radio is switched off.
  virtual void on_frame_cut(hal::Time at, const Frame& frame) { (void)at, (void)frame; }
  /// Right before on_reception(), if the radio was synchronised to the frame: lowest SINR over the
  /// frame.
  virtual void on_sinr(double sinr_db) { (void)sinr_db; }
  /// Result of a frame at one radio, whether addressed to it or not, that could receive or sense
  /// the frame by itself, or could without walls.
  virtual void on_reception(hal::Time at, const Frame& frame, hal::AgentId receiver,
                            hal::Verdict verdict, double rssi_dbm) {
    (void)at, (void)frame, (void)receiver, (void)verdict, (void)rssi_dbm;
  }
  /// A frame's payload was passed to the station's client; Fig. 12 of the paper counts these.
  virtual void on_delivered(hal::Time at, const Frame& frame, hal::AgentId receiver) {
    (void)at, (void)frame, (void)receiver;
  }
  /// A request ended at its source station.
  virtual void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                              hal::Verdict verdict) {
    (void)at, (void)sender, (void)destination, (void)verdict;
  }
  /// An access point could not relay a frame from `source`, whose request has ended before.
  virtual void on_relay_lost(hal::Time at, hal::AgentId source, const MacRequest& request,
                             hal::Verdict verdict) {
    (void)at, (void)source, (void)request, (void)verdict;
  }
  /// An access point queues a frame of another station.
  virtual void on_relay_queued(hal::Time at, const Msdu& msdu) { (void)at, (void)msdu; }
  /// Only of queues for receivers.
  virtual void on_queue(hal::Time at, const QueueChange& change) { (void)at, (void)change; }
  /// An MSDU ended at a station that was to send it, or at an access point that was to relay it; or
  /// it was received, and the station that it is for could not use it. Its last frame, if any, was
  /// reported before, and so was the reception of that frame if it has only one receiver.
  virtual void on_msdu_end(hal::Time at, const Msdu& msdu, const MsduEnd& end) {
    (void)at, (void)msdu, (void)end;
  }
  /// A station is now associated with this access point; nullopt: with none.
  virtual void on_association(hal::Time at, hal::AgentId station,
                              std::optional<hal::AgentId> access_point) {
    (void)at, (void)station, (void)access_point;
  }
};

}  // namespace sim::radio
