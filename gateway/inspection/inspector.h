#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/inspection/inspection_participant.h"
#include "hal/types/channel.h"
#include "hal/types/geometry.h"
#include "hal/types/message.h"
#include "hal/types/route.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"

namespace gateway::inspection {

/// A range sensor of a robot, as `rt/<agent>/range` names it.
struct InspectedRange {
  std::string name;          ///< Its frame is "<agent>/<name>".
  double field_of_view = 0;  ///< rad, whole angle
  double min_range = 0;      ///< m
  double max_range = 0;      ///< m
  hal::Vec3 position;        ///< m, in <agent>/base_link
  double heading = 0;        ///< rad, about z of <agent>/base_link
};

/// An agent with topics of its own.
struct InspectedRobot {
  std::string name;
  bool drives = true;               ///< A mote does not: it has no odometry and no ranges.
  std::optional<hal::Pose2> start;  ///< Of frame "<agent>/odom" in "world"; none: not known.
  std::vector<InspectedRange> ranges;
  /// Shown as rt/<agent>/<channel>, if their kind has a type of ROS 2: see channel_writer.h.
  std::vector<hal::Channel> channels{};
};

/// Shows a run or a robot to standard tools, in names and types of ROS 2 (release Humble) where one
/// exists:
///
/// topic                        type                             what
/// rt/clock                     rosgraph_msgs/Clock              the run's time; not of a robot
/// rt/tf                        tf2_msgs/TFMessage               world -> <agent>/base_link
/// rt/tf_static                 tf2_msgs/TFMessage               world -> <agent>/odom, base_link
/// ->
///                                                               sensors; kept for late readers
/// rt/<agent>/odom              nav_msgs/Odometry                <agent>/odom -> base_link
/// rt/<agent>/range             sensor_msgs/Range                one sample per sensor
/// rt/<agent>/<channel>         by the kind of the channel       of InspectedRobot::channels
/// rt/baraka/message_fates      baraka_msgs/MessageFate
/// rt/baraka/frames             baraka_msgs/Frame                not every one
/// rt/baraka/routes             baraka_msgs/Route
/// rt/baraka/controller_states  baraka_msgs/ControllerState
/// rt/baraka/values             baraka_msgs/Value                that controllers record
/// rt/baraka/link_quality       baraka_msgs/LinkQuality
/// and those of AirInspector and MarkerInspector.
///
/// Nothing is written while no reader of that topic is matched; publishing then costs one load.
/// Otherwise it costs the time of a write; it never waits for a reader: samples that a slow reader
/// has not taken are replaced by newer ones. Agents by name. Frames as in ROS REP 103 and 105:
/// x forward, y left, z up. One thread at a time, except has_readers(): any thread.
class Inspector {
 public:
  enum class Topic : std::uint8_t {
    kClock,
    kTransforms,
    kOdometry,  ///< Of any robot.
    kRange,     ///< Of any robot.
    kChannels,  ///< Any channel of any robot.
    kFates,
    kFrames,
    kRoutes,
    kStates,
    kValues,
    kLinks,
  };

  /// What became of a message.
  struct MessageEnd {
    std::string_view sender;
    hal::MessageId id = 0;
    std::string_view node;                ///< Where it was seen.
    std::optional<hal::Fate> fate;        ///< As the sender was told; or
    std::optional<hal::Verdict> verdict;  ///< how a copy ended at the node.
  };
  struct FrameStart {
    std::string_view transmitter, receiver;
    std::string_view type;  ///< "data", "rts", "cts", "ack"
    std::uint16_t sequence = 0;
    bool retry = false;
    std::uint32_t bits = 0;
    hal::Duration airtime{};
    std::uint32_t skipped = 0;  ///< Frames not shown since the one before.
  };
  struct RouteEntry {
    std::string_view agent, destination, next_hop;
    const hal::RouteChange& change;  ///< Its addresses are not looked at.
  };
  struct Link {
    std::string_view receiver, transmitter;
    double rssi_dbm = 0;                    ///< Of the last frame; NaN where the link cannot tell.
    std::uint32_t delivered = 0, lost = 0;  ///< Frames since the sample before.
  };

  /// Whether the stamps are the time of a simulation, which rt/clock tells; otherwise they are that
  /// of the day, and nobody may write rt/clock: every program of ROS 2 with use_sim_time in the
  /// domain would follow it.
  enum class Stamps : std::uint8_t { kSimulated, kTimeOfDay };

  /// @param robots  get topics of their own; in calls they are named by their index here.
  /// @throws std::runtime_error  if DDS makes no writer.
  Inspector(InspectionParticipant& participant, const std::vector<InspectedRobot>& robots,
            Stamps stamps = Stamps::kSimulated);
  ~Inspector();
  Inspector(const Inspector&) = delete;
  Inspector& operator=(const Inspector&) = delete;

  bool has_readers() const noexcept;  ///< Of anything but rt/tf_static.
  bool has_readers(Topic topic) const noexcept;
  bool has_readers(std::size_t robot, std::uint16_t channel) const;  ///< Of publish_channel().

  void publish_clock(hal::Time now);  ///< No effect without rt/clock.
  /// Pose of `<agent>/base_link` in world: m, rad.
  void publish_transform(hal::Time at, std::string_view agent, const hal::Pose2& pose);
  /// @param pose  in `<agent>/odom`: since the start.  @param twist  in the body's frame.
  void publish_odometry(hal::Time at, std::size_t robot, const hal::Pose2& pose,
                        const hal::Twist2& twist);
  /// @param metres  one per sensor of the robot; NaN: nothing within reach, shown as +infinity (ROS
  ///   REP 117). More values than sensors are not looked at.
  void publish_ranges(hal::Time at, std::size_t robot, std::span<const double> metres);
  /// @param channel  its number, Channel::id. No effect if it is not shown.
  void publish_channel(hal::Time at, std::size_t robot, std::uint16_t channel,
                       std::span<const double> values);
  void publish_fate(hal::Time at, const MessageEnd& end);
  void publish_frame(hal::Time at, const FrameStart& frame);
  void publish_route(hal::Time at, const RouteEntry& entry);
  void publish_state(hal::Time at, std::string_view agent, std::string_view state);
  void publish_value(hal::Time at, std::string_view agent, std::string_view name, double value);
  void publish_link(hal::Time at, const Link& link);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::inspection
