#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/geometry.h"
#include "hal/types/solid.h"

namespace sim::report {

/// Messages of ROS 2 (release Humble Hawksbill) and ours of idl/inspect.idl, as bytes of CDR.
/// Frames as in ROS REP 103 and 105: x forward, y left, z up. Times are ns, not negative, within
/// 2^31 s.

struct RosHeader {
  std::int64_t at_ns = 0;
  std::string frame;
};

struct RosTransform {
  RosHeader header;
  std::string child;
  hal::Vec3 translation;  ///< m
  double yaw = 0;         ///< rad
};

struct RosMarker {
  std::int64_t at_ns = 0;
  std::string name;  ///< Its namespace.
  std::int32_t id = 0;
  hal::Solid solid;
  hal::Pose2 pose;  ///< Of the frame of `solid` in the world.
  hal::Colour colour{};
};

/// One beam, or one of several of a sensor.
struct RosRange {
  RosHeader header;
  bool is_infrared = true;              ///< Else ultrasound.
  double field_of_view = 0;             ///< rad
  double low = 0, high = 0, range = 0;  ///< m; range: NaN for nothing within reach.
};

struct RosScan {
  RosHeader header;
  double first = 0, last = 0, step = 0;  ///< rad
  double period = 0;                     ///< s
  double low = 0, high = 0;              ///< m
  std::vector<double> ranges;            ///< m; NaN for nothing within reach.
};

struct RosBattery {
  double charge = 0;         ///< 0 .. 1
  double volts = 0;          ///< V
  double drawn_amperes = 0;  ///< A
};

struct RosRoute {
  std::int64_t at_ns = 0;
  std::string agent, topic, destination, next_hop;
  bool removed = false;
  std::uint16_t hops = 0;
  std::int64_t delay_ns = 0;
  double min_snr_db = 0, energy = 0;
};

struct RosFrame {
  std::int64_t at_ns = 0;
  std::string transmitter, receiver, type;
  std::uint16_t sequence = 0;
  bool retry = false;
  std::uint32_t bits = 0;
  std::int64_t airtime_ns = 0;
};

struct RosFate {
  std::int64_t at_ns = 0;
  std::string sender;
  std::uint32_t id = 0;
  std::string node, fate, verdict;
};

std::string pose_stamped(const RosHeader& header, const hal::Pose2& pose);
std::string tf_message(std::span<const RosTransform> transforms);
/// @param twist  in the body's frame.
std::string odometry(const RosHeader& header, std::string_view child, const hal::Pose2& pose,
                     const hal::Twist2& twist);
std::string range_message(const RosRange& range);
std::string laser_scan(const RosScan& scan);
std::string bool_message(bool value);
/// @param turn  rad/s.  @param force  specific, m/s^2
std::string imu_message(const RosHeader& header, const hal::Vec3& turn, const hal::Vec3& force);
std::string battery_state(const RosHeader& header, const RosBattery& battery);
std::string route_message(const RosRoute& route);
std::string marker_array(std::span<const RosMarker> markers);
std::string frame_message(const RosFrame& frame);
std::string message_fate(const RosFate& fate);
std::string controller_state(std::int64_t at_ns, std::string_view agent, std::string_view state);
std::string value_message(std::int64_t at_ns, std::string_view agent, std::string_view name,
                          double value);

}  // namespace sim::report
