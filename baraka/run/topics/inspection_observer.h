#pragma once

#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "baraka/run/topics/marker_publisher.h"
#include "gateway/inspection/air_inspector.h"
#include "gateway/inspection/inspector.h"
#include "sim/agents/observer.h"
#include "sim/agents/simulation_config.h"
#include "sim/air/ledger.h"

namespace baraka::run::topics {

/// Publishes a running simulation on the topics of gateway::inspection::Inspector, AirInspector and
/// MarkerInspector. It only observes: the run is the same with and without readers.
///
///   InspectionObserver inspection(config);
///   Simulation simulation(config, {…, &inspection});
///   inspection.start(participant);
///   …run…
class InspectionObserver final : public sim::agents::Observer {
 public:
  /// @param config  must outlive this object.
  explicit InspectionObserver(const sim::agents::SimulationConfig& config);

  /// Starts publishing. @param participant  must outlive this object.
  /// @throws std::runtime_error  if DDS makes no writer.
  void start(gateway::inspection::InspectionParticipant& participant);

  /// Sets the account of the use of the air to publish. @param ledger  must outlive the run; null:
  /// nothing about the air is published.
  void set_ledger(const sim::air::Ledger* ledger) { ledger_ = ledger; }

  void on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) override;
  bool observes_readings() const override;
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override;
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override;
  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_fate(hal::Time at, hal::AgentId sender, hal::MessageId id, hal::Fate fate) override;
  void on_message_end(hal::Time at, hal::AgentId at_node, hal::AgentId sender, hal::MessageId id,
                      hal::Verdict verdict) override;
  void on_route_change(hal::Time at, hal::AgentId agent, const hal::RouteChange& change) override;
  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override;

 private:
  using Topic = gateway::inspection::Inspector::Topic;

  struct Agent {
    std::string name;
    std::size_t robot = 0;       ///< Index among the inspector's robots, if it is one.
    hal::Pose2 shown;            ///< The last published pose.
    hal::Time shown_at{kNever};  ///< Time of the last published pose.
  };
  struct Heard {
    std::uint32_t delivered = 0, lost = 0;
    hal::Time shown_at{kNever};
  };
  static constexpr hal::Duration kNever = -std::chrono::hours{1};

  bool is_read(Topic topic) const { return inspector_ && inspector_->has_readers(topic); }
  std::string_view name(hal::AgentId agent) const;
  void show_clock(hal::Time at);
  void show_air(hal::Time at);

  const sim::agents::SimulationConfig& config_;
  std::map<hal::AgentId, Agent> agents_;
  std::unique_ptr<gateway::inspection::Inspector> inspector_;  ///< Null until start().
  std::unique_ptr<gateway::inspection::AirInspector> air_;     ///< Null if no agent has a network.
  MarkerPublisher markers_;
  const sim::air::Ledger* ledger_ = nullptr;
  hal::Time clock_shown_{kNever}, frame_shown_{kNever}, air_shown_{kNever};
  std::uint32_t frames_skipped_ = 0;
  std::map<std::pair<hal::AgentId, hal::AgentId>, Heard> links_;  ///< By receiver, transmitter.
};

}  // namespace baraka::run::topics
