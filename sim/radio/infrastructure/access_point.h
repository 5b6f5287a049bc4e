#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>

#include "sim/radio/infrastructure/bss_mac.h"
#include "sim/radio/infrastructure/distribution_system.h"
#include "sim/radio/infrastructure/management.h"

namespace sim::radio {

/// An access point and the station in it (IEEE Std 802.11-2016, 4.3.2 and 11.3): sends beacons,
/// answers association requests, and forwards frames of its stations to another station, to the
/// distribution system, or, group frames, to both.
class AccessPoint final : public BssMac, private DistributionPort {
 public:
  struct Network {
    const BssConfig& config;  ///< Outlives the access point, as does `distribution`.
    BssParameters bss;
    DistributionSystem& distribution;
    hal::Duration first_beacon;  ///< First target beacon transmission time.
    /// RSSI and SNR reported for its own frames that the distribution system carries to another
    /// access point.
    double rssi_dbm, snr_db;
  };

  AccessPoint(const Context& context, const DcfConfig& config, std::unique_ptr<Ieee80211Mac> dcf,
              const Network& network);

 private:
  void on_frame(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) override;
  std::optional<MacRequest> frame_for(const Waiting& waiting) override;
  void on_management_sent(const MacRequest& request, hal::Verdict verdict) override;
  void on_radio(bool on) override;

  hal::AgentId address() const override { return agent(); }
  void on_distributed(const Distributed& distributed) override;
  void on_moved(hal::AgentId station) override;

  void schedule_beacon(hal::Time target);
  void send_beacon();

  void on_management(const Frame& frame);
  void on_authentication(const Frame& frame);
  void on_association_request(const Frame& frame);
  void on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void dismiss(hal::AgentId station);
  void forget(hal::AgentId station);
  /// Sends a frame to a station of its own BSS.
  void relay(const MacRequest& request, hal::AgentId source);
  std::optional<std::uint16_t> free_association_id() const;
  void update_ht_operation();
  void answer(FrameType type, hal::AgentId station, hal::Bytes body);
  bool has(hal::AgentId station) const { return associated_.contains(station); }

  Network network_;
  bool beacon_waits_ = false;
  std::set<hal::AgentId> authenticated_;
  /// Association identifiers in responses that are not acknowledged yet.
  std::map<hal::AgentId, std::uint16_t> offered_;
  std::map<hal::AgentId, std::uint16_t> associated_;  ///< Association identifiers.
};

}  // namespace sim::radio
