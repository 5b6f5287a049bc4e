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

/// A range sensor of a robot, published on `rt/<agent>/range`.
struct InspectedRange {
  std::string name;          ///< Its frame is "<agent>/<name>".
  double field_of_view = 0;  ///< rad, full angle
  double min_range = 0;      ///< m
  double max_range = 0;      ///< m
  hal::Vec3 position;        ///< m, in <agent>/base_link
  double heading = 0;        ///< rad, about z of <agent>/base_link
};

/// An agent with topics of its own.
struct InspectedRobot {
  std::string name;
  bool drives = true;  ///< False for a mote, which has neither odometry nor ranges.
  /// Pose of the frame "<agent>/odom" in "world"; none: not known.
  std::optional<hal::Pose2> start;
  std::vector<InspectedRange> ranges;
  /// Published on rt/<agent>/<channel> if their kind has a ROS 2 type, see channel_writer.h.
  std::vector<hal::Channel> channels{};
};

/// Publishes a run or a robot for standard tools, with the names and types of ROS 2 (Humble) where
/// there are any:
///
/// topic                        type                             what
/// rt/clock                     rosgraph_msgs/Clock              simulated time; not of a robot
/// rt/tf                        tf2_msgs/TFMessage               world -> <agent>/base_link
/// rt/tf_static                 tf2_msgs/TFMessage               world -> <agent>/odom and
///                                                               base_link -> sensors; kept for
///                                                               readers that join later
/// rt/<agent>/odom              nav_msgs/Odometry                <agent>/odom -> base_link
/// rt/<agent>/range             sensor_msgs/Range                one sample per sensor
/// rt/<agent>/<channel>         by the kind of the channel       of InspectedRobot::channels
/// rt/baraka/message_fates      baraka_msgs/MessageFate
/// rt/baraka/frames             baraka_msgs/Frame                a selection of the frames
/// rt/baraka/routes             baraka_msgs/Route
/// rt/baraka/controller_states  baraka_msgs/ControllerState
/// rt/baraka/values             baraka_msgs/Value                recorded by controllers
/// rt/baraka/link_quality       baraka_msgs/LinkQuality
/// and those of AirInspector and MarkerInspector.
///
/// While a topic has no matched reader nothing is written, and publishing costs one atomic load.
/// Otherwise it costs the time of a write. It never waits for a reader: newer samples replace those
/// that a slow reader has not taken. Agents are given by name. Coordinate frames follow ROS REP 103
/// and 105: x forward, y left, z up. One thread at a time, except has_readers(): any thread.
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

  /// The fate of a message, or the verdict on a copy of it.
  struct MessageEnd {
    std::string_view sender;
    hal::MessageId id = 0;
    std::string_view node;                ///< The agent where this happened.
    std::optional<hal::Fate> fate;        ///< What the sender was told. Either this …
    std::optional<hal::Verdict> verdict;  ///< … or how a copy ended at the node is set.
  };
  struct FrameStart {
    std::string_view transmitter, receiver;
    std::string_view type;  ///< "data", "rts", "cts", "ack"
    std::uint16_t sequence = 0;
    bool retry = false;
    std::uint32_t bits = 0;
    hal::Duration airtime{};
    std::uint32_t skipped = 0;  ///< Number of frames not published since the previous sample.
    double rate = 0;            ///< bit/s; 0: not known.
    std::string_view modulation{};
    int mcs = -1;  ///< -1: it has none, nor what follows.
    int streams = 0, width_mhz = 0;
    std::int64_t guard_ns = 0;
    std::string_view access_category{};  ///< Empty: no QoS data.
    std::uint32_t ampdu = 0;             ///< As Frame::ampdu.
  };
  struct RouteEntry {
    std::string_view agent, destination, next_hop;
    const hal::RouteChange& change;  ///< Its addresses are ignored.
  };
  struct Link {
    std::string_view receiver, transmitter;
    double rssi_dbm = 0;                    ///< Of the last frame; NaN: not known.
    std::uint32_t delivered = 0, lost = 0;  ///< Frames since the previous sample.
  };

  /// kSimulated: stamps are simulated time, which rt/clock publishes. kTimeOfDay: stamps are the
  /// time of day, and rt/clock is not written, because every ROS 2 program with use_sim_time in the
  /// domain would follow it.
  enum class Stamps : std::uint8_t { kSimulated, kTimeOfDay };

  /// @param robots  get topics of their own; calls identify them by their index here.
  /// @throws std::runtime_error  if DDS makes no writer.
  Inspector(InspectionParticipant& participant, const std::vector<InspectedRobot>& robots,
            Stamps stamps = Stamps::kSimulated);
  ~Inspector();
  Inspector(const Inspector&) = delete;
  Inspector& operator=(const Inspector&) = delete;

  bool has_readers() const noexcept;  ///< Whether any topic except rt/tf_static has readers.
  bool has_readers(Topic topic) const noexcept;
  /// Whether the topic of publish_channel() for this channel has readers.
  bool has_readers(std::size_t robot, std::uint16_t channel) const;

  void publish_clock(hal::Time now);  ///< No effect with Stamps::kTimeOfDay.
  /// @param pose  of `<agent>/base_link` in world: m, rad.
  void publish_transform(hal::Time at, std::string_view agent, const hal::Pose2& pose);
  /// @param pose  in `<agent>/odom`, that is relative to the start: m, rad.
  /// @param twist  in the body's frame: m/s, rad/s.
  void publish_odometry(hal::Time at, std::size_t robot, const hal::Pose2& pose,
                        const hal::Twist2& twist);
  /// @param metres  one per sensor of the robot; NaN: nothing within range, published as +infinity
  ///   (ROS REP 117). Values beyond the number of sensors are ignored.
  void publish_ranges(hal::Time at, std::size_t robot, std::span<const double> metres);
  /// @param channel  Channel::id. No effect if the channel is not published.
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
