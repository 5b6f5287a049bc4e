#pragma once

#include <string>
#include <vector>

#include "hal/robot/platform/boot_time.h"
#include "hal/types/agent_id.h"
#include "hal/types/geometry.h"
#include "hal/types/result.h"

namespace hal::robot::agent {

/// Measured pose of this agent in the world frame.
struct PoseFix {
  Pose2 pose;
  platform::BootTime stamp;  ///< Time of its arrival here.
};

/// Provides the agent's pose from motion capture, a localisation node, or the file of an agent that
/// does not move. For `driver: pose_topic` it is a DDS reader, which the program supplies.
class PoseSource {
 public:
  virtual ~PoseSource() = default;

  /// The last fix, of any age. Does not block; any thread. Errors: kNotAvailable (none yet).
  virtual Result<PoseFix> pose() const = 0;
};

/// An agent that stands where its file says. The fix is always fresh.
class StaticPose final : public PoseSource {
 public:
  explicit StaticPose(const Pose2& pose) : pose_(pose) {}
  Result<PoseFix> pose() const override { return PoseFix{pose_, platform::BootClock::now()}; }

 private:
  Pose2 pose_;
};

/// Another agent with a known position.
struct Landmark {
  AgentId agent;
  std::string name;
  Vec2 position;  ///< m, world frame
  bool operator==(const Landmark&) const = default;
};

/// The landmarks within `range` [m] of an agent, as a reading of the channel "localisation":
/// triples (address, x, y), by address; x and y in metres in the body frame of `self`.
/// @param map  by address.
std::vector<double> relative_positions(const Pose2& self, AgentId self_id,
                                       const std::vector<Landmark>& map, double range);

}  // namespace hal::robot::agent
