#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/random.h"
#include "sim/core/event_queue.h"
#include "sim/radio/bss_config.h"
#include "sim/radio/frame.h"
#include "sim/radio/heard_access_points.h"
#include "sim/radio/management.h"

namespace sim::radio {

/// Association of a station (IEEE Std 802.11-2016, 11.3): it listens for beacons, selects the
/// strongest access point, and changes when another one is stronger by more than the hysteresis.
///
///   kOff --start()--> kScanning --scan time over, one was heard--> kAuthenticating
///   kAuthenticating --answered--> kAssociating --answered--> kAssociated
///   kAssociated --a better one--> kAuthenticating (with that one; then reassociation)
///   kAuthenticating, kAssociating --no answer--> kAssociated, if it was before; else kScanning
///   kAssociated --no beacons, or deauthenticated--> kAuthenticating if another one is heard, or
///   kScanning
///
/// Stations that start together would all ask in the same slot, and those that were not answered
/// would ask together again. So a scan that begins with a start, a loss or a failure is longer by a
/// random part, whose range grows with each failure until the station is associated.
///
/// During a handover it stays associated with the old one, also if the new one does not answer.
class Association {
 public:
  /// What it does in the world.
  class Client {
   public:
    virtual ~Client() = default;
    virtual void send(FrameType type, hal::AgentId access_point, hal::Bytes body) = 0;
    /// access_point() or is_settled() changed.
    virtual void on_association() = 0;
  };

  struct Station {
    hal::AgentId agent;
    BssParameters bss;
    hal::RandomStream random;  ///< "<agent>/scan"
  };

  /// @param config, client  outlive it.
  Association(EventQueue& events, Station station, const BssConfig& config, Client& client);

  /// The radio was switched on or off.
  void start();
  void stop();

  /// With which it is associated; none: with none.
  std::optional<hal::AgentId> access_point() const { return access_point_; }
  /// It is associated, and not about to change over.
  bool is_settled() const { return state_ == State::kAssociated; }

  /// A beacon of an access point that the station may use.
  void on_beacon(const Frame& frame, hal::Dbm rssi);
  /// Any other management frame to this station.
  void on_management(const Frame& frame);
  /// A frame of its own was not acknowledged.
  void on_unanswered(FrameType type, hal::AgentId access_point);

 private:
  enum class State : std::uint8_t { kOff, kScanning, kAuthenticating, kAssociating, kAssociated };

  void scan_anew();
  void scan(hal::Duration time);
  void on_scanned();
  void begin(hal::AgentId access_point);
  void wait_for_answer();
  void give_up();
  void on_authentication(const Frame& frame);
  void on_response(const Frame& frame);
  void on_dismissal(hal::AgentId by);
  void lose();
  void watch();
  void change(State state, std::optional<hal::AgentId> access_point);

  EventQueue& events_;
  Station station_;
  const BssConfig& config_;
  Client& client_;

  HeardAccessPoints heard_;
  State state_ = State::kOff;
  hal::Duration spread_{};  ///< Range of the random part of the next scan.
  std::optional<hal::AgentId> access_point_;
  hal::AgentId target_{};      ///< While kAuthenticating and kAssociating.
  EventQueue::EventId timer_;  ///< The end of the scan, or of the wait for an answer.
  EventQueue::EventId loss_;   ///< When the access point's beacons have stayed away.
};

}  // namespace sim::radio
