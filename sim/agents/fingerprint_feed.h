#pragma once

#include <functional>
#include <optional>
#include <utility>

#include "sim/agents/observer.h"
#include "sim/core/fingerprint.h"

namespace sim::agents {

/// Adds everything that is observed to a fingerprint, bit by bit, except what depends on how the
/// run was computed (wall time, processes, sequence numbers).
class FingerprintFeed final : public Observer {
 public:
  FingerprintFeed() = default;
  /// @param sink  as in the constructor of Fingerprint.
  explicit FingerprintFeed(std::function<void(const Fingerprint::Row&)> sink)
      : fingerprint_(std::move(sink)) {}

  const Fingerprint& fingerprint() const { return fingerprint_; }
  void finish() { fingerprint_.finish(); }

  void on_frame_start(hal::Time at, const radio::Frame& frame) override;
  void on_reception(hal::Time at, const radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_relay_lost(hal::Time at, hal::AgentId source, const radio::MacRequest& request,
                     hal::Verdict verdict) override;
  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override;
  void on_body(hal::Time at, hal::AgentId agent, const BodyState& body) override;
  void on_movable(hal::Time at, std::uint32_t number, const physics::BodyPose& pose) override;
  void on_air_entered(hal::Time at, hal::AgentId agent, const radio::MacRequest& request) override;
  void on_event(const hal::node::exchange::Event& event) override;
  void on_action(hal::Time at, const hal::node::exchange::Action& action) override;
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;

 private:
  Fingerprint fingerprint_;
};

}  // namespace sim::agents
