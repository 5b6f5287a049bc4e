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

/// What of bodies and walls goes to rt/markers: what has moved, at most ten times a second of
/// simulated time; and all of it when somebody begins to read, and once a second, so that nobody
/// misses for long what was lost. Nothing while nobody reads.
class MarkerPublisher {
 public:
  explicit MarkerPublisher(const sim::agents::SimulationConfig& config);

  /// @throws std::runtime_error  if DDS makes no writer.
  void start(gateway::inspection::InspectionParticipant& participant);

  /// Calls come by time; an instant is shown when the next one begins, so all of it is there.
  void on_body(hal::Time at, hal::AgentId agent, const hal::Pose2& pose);

 private:
  struct Body {
    hal::DrawnBody drawn;
    hal::Pose2 pose;
    bool is_known = false;  ///< Since somebody reads.
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
