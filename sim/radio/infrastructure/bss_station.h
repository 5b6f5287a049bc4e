#pragma once

#include <memory>
#include <vector>

#include "sim/radio/infrastructure/association.h"
#include "sim/radio/infrastructure/bss_mac.h"

namespace sim::radio {

/// A station of an infrastructure network. It sends all data To DS, to its access point, and queues
/// them while it is not associated or a handover is in progress; it receives data From DS, from its
/// access point. Its own group frames return from the access point and are dropped.
class BssStation final : public BssMac, private Association::Client {
 public:
  struct Membership {
    const BssConfig& config;  ///< Outlives the station.
    BssParameters bss;
    std::vector<hal::AgentId> access_points;  ///< Those that it may use.
    hal::RandomStream scan;                   ///< "<agent>/scan"
  };

  BssStation(const Context& context, const DcfConfig& config, std::unique_ptr<Ieee80211Mac> dcf,
             Membership membership);

 private:
  void on_frame(const Frame& frame, hal::Dbm rssi, hal::Decibels snr) override;
  std::optional<MacRequest> frame_for(const Waiting& waiting) override;
  bool is_open() const override { return association_.is_settled(); }
  /// All data go to the access point.
  hal::AgentId queue_for(hal::AgentId) const override { return hal::kEveryone; }
  void on_management_sent(const MacRequest& request, hal::Verdict verdict) override;
  void on_radio(bool on) override;

  void send(FrameType type, hal::AgentId access_point, hal::Bytes body) override;
  void on_association() override;

  bool may_use(hal::AgentId access_point) const;
  void on_beacon(const Frame& frame, hal::Dbm rssi);
  void on_data(const Frame& frame, hal::Dbm rssi, hal::Decibels snr);
  void heed(const Frame& frame);

  std::vector<hal::AgentId> access_points_;
  const bool has_ht_;
  Association association_;
  std::optional<hal::AgentId> told_;  ///< Access point last reported to the observer.
};

}  // namespace sim::radio
