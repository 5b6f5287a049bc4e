#pragma once

#include <map>
#include <memory>
#include <vector>

#include "gateway/inspection/marker_inspector.h"
#include "hal/types/agent_id.h"
#include "hal/types/solid.h"
#include "hal/types/time.h"
#include "sim/agents/simulation_config.h"

namespace baraka::run::topics {

/// Publishes bodies and walls on rt/markers: bodies that have moved, at most ten times per second
/// of simulated time; everything when a reader joins and once per second, so that lost samples do
/// not matter for long. Publishes nothing while there is no reader.
class MarkerPublisher {
 public:
  explicit MarkerPublisher(const sim::agents::SimulationConfig& config);

  /// @throws std::runtime_error  if DDS makes no writer.
  void start(gateway::inspection::InspectionParticipant& participant);

  /// @pre Calls are in the order of time. An instant is published when the next one begins, when
  /// all its bodies are known.
  void on_body(hal::Time at, hal::AgentId agent, const hal::Pose2& pose);

 private:
  struct Body {
    hal::DrawnBody drawn;
    hal::Pose2 pose;
    bool is_known = false;  ///< The pose has been set since a reader joined.
    bool has_moved = false;
  };
  static constexpr hal::Duration kNever = -std::chrono::hours{1};

  bool is_read();
  void show();

  std::vector<hal::DrawnBody> walls_;
  std::map<hal::AgentId, Body> bodies_;
  std::unique_ptr<gateway::inspection::MarkerInspector> inspector_;  ///< Null until start().
  int readers_ = 0;
  hal::Time now_{kNever}, shown_at_{kNever}, all_shown_at_{kNever};
};

}  // namespace baraka::run::topics
