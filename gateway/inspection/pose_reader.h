#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/geometry.h"

namespace gateway::inspection {

/// A pose from an external source such as motion capture or a localisation node.
struct OutsidePose {
  hal::Pose2 pose;                  ///< m, rad; in frame `frame`. z, roll and pitch are dropped.
  std::string frame;                ///< The sender's name of the frame.
  std::int64_t sender_time_ns = 0;  ///< Time stamp of the message, by the sender's clock.
};

/// Reads geometry_msgs/PoseStamped (ROS 2 Humble) from a topic, best effort, and keeps the latest.
/// Poses whose x or y is not finite, or whose orientation is not a unit quaternion (to 1e-3), are
/// dropped and counted.
class PoseReader {
 public:
  /// @param topic  name in ROS 2, for example "/mocap/r0/pose", which is "rt/mocap/r0/pose" in DDS;
  ///   or the name in DDS, with "rt/".
  /// @param on_pose  called on a thread of DDS with each valid pose; may be empty.
  /// @throws std::runtime_error  if DDS makes no reader.
  PoseReader(InspectionParticipant& participant, const std::string& topic,
             std::function<void(const OutsidePose&)> on_pose = {});
  ~PoseReader();
  PoseReader(const PoseReader&) = delete;
  PoseReader& operator=(const PoseReader&) = delete;

  std::optional<OutsidePose> last() const;  ///< Any thread.
  std::uint64_t dropped() const;            ///< Number of dropped poses. Any thread.
  int writers() const;                      ///< Writers matched now. Any thread.

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
