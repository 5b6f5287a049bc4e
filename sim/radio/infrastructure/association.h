#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/random.h"
#include "sim/core/event_queue.h"
#include "sim/radio/infrastructure/bss_config.h"
#include "sim/radio/infrastructure/heard_access_points.h"
#include "sim/radio/infrastructure/management.h"
#include "sim/radio/mac/frame.h"

namespace sim::radio {

/// Association of a station (IEEE Std 802.11-2016, 11.3): it listens for beacons, associates with
/// the strongest access point, and hands over when another one is stronger by more than the
/// hysteresis.
///
///   kOff --start()--> kScanning --scan time over, beacons heard--> kAuthenticating
///   kAuthenticating --response--> kAssociating --response--> kAssociated
///   kAssociated --better access point--> kAuthenticating (with it; then reassociation)
///   kAuthenticating, kAssociating --no response--> kAssociated during a handover, else kScanning
///   kAssociated --beacons lost, or deauthenticated--> kAuthenticating if another access point is
///   heard, else kScanning
///
/// Stations that start together would all send their requests in the same slot, and those without a
/// response would repeat them together. A scan that begins with a start, a loss or a failure is
/// therefore longer by a random part, whose range grows with each failure until the station is
/// associated.
///
/// During a handover the station stays associated with the old access point until the new one has
/// accepted it.
class Association {
 public:
  /// What the association needs from its station.
  class Client {
   public:
    virtual ~Client() = default;
    virtual void send(FrameType type, hal::AgentId access_point, hal::Bytes body) = 0;
    /// Called when access_point() or is_settled() has changed.
    virtual void on_association() = 0;
  };

  struct Station {
    hal::AgentId agent;
    BssParameters bss;
    hal::RandomStream random;  ///< "<agent>/scan"
  };

  /// @param config,client  outlive the association.
  Association(EventQueue& events, Station station, const BssConfig& config, Client& client);

  /// Called when the radio is switched on or off.
  void start();
  void stop();

  /// EDCA parameters that the access point announced when it accepted the station.
  const std::optional<EdcaConfig>& edca() const { return edca_; }
  /// Access point with which the station is associated; nullopt if there is none.
  std::optional<hal::AgentId> access_point() const { return access_point_; }
  /// Whether it is associated and no handover is in progress.
  bool is_settled() const { return state_ == State::kAssociated; }

  /// Called for a beacon of an access point that the station may use.
  void on_beacon(const Frame& frame, hal::Dbm rssi);
  /// Called for any other management frame to this station.
  void on_management(const Frame& frame);
  /// Called when a management frame of this station was not acknowledged.
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
  std::optional<EdcaConfig> edca_;
  hal::AgentId target_{};      ///< Candidate while kAuthenticating and kAssociating.
  EventQueue::EventId timer_;  ///< End of the scan, or of the wait for a response.
  EventQueue::EventId loss_;  ///< Time at which missing beacons mean that the access point is lost.
};

}  // namespace sim::radio
