#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/geometry.h"

namespace gateway::inspection {

/// A pose from outside: motion capture, a localisation node.
struct OutsidePose {
  hal::Pose2 pose;                  ///< m, rad; of frame `frame`. z, roll and pitch are dropped.
  std::string frame;                ///< As the sender names it.
  std::int64_t sender_time_ns = 0;  ///< Stamp of the message, on the sender's clock.
};

/// Reads geometry_msgs/PoseStamped (ROS 2 Humble) from a topic: best effort, the last one counts.
/// Poses with a value that is not finite, or an orientation that is no rotation, are dropped and
/// counted.
class PoseReader {
 public:
  /// @param topic  as in ROS 2, e.g. "/mocap/r0/pose": "rt/mocap/r0/pose" in DDS; a leading "rt/"
  /// is
  ///   taken as it is.
  /// @param on_pose  called on a thread of DDS with each good pose; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  PoseReader(InspectionParticipant& participant, const std::string& topic,
             std::function<void(const OutsidePose&)> on_pose = {});
  ~PoseReader();
  PoseReader(const PoseReader&) = delete;
  PoseReader& operator=(const PoseReader&) = delete;

  std::optional<OutsidePose> last() const;  ///< Any thread.
  std::uint64_t dropped() const;            ///< Malformed poses. Any thread.
  int writers() const;                      ///< In sight now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
