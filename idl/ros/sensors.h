#pragma once

#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace idl::ros {

// ROS 2 message of each kind of channel, for topics of a run and for MCAP files alike. describe()
// sets the fields that are the same for all readings; measure() sets those of a reading of at least
// kValues values. Infrared and odometry are not among these kinds, because they are always
// published.

struct Battery {
  using Message = sensor_msgs::msg::dds_::BatteryState_;
  static constexpr std::string_view kKind = "battery";
  static constexpr std::size_t kValues = 3;
  static void describe(Message& message, const std::string& agent, const hal::Channel& channel);
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

struct Bumper {
  using Message = std_msgs::msg::dds_::Bool_;
  static constexpr std::string_view kKind = "bumper";
  static constexpr std::size_t kValues = 1;
  static void describe(Message&, const std::string&, const hal::Channel&) {}
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

struct Imu {
  using Message = sensor_msgs::msg::dds_::Imu_;
  static constexpr std::string_view kKind = "imu";
  static constexpr std::size_t kValues = 6;
  static void describe(Message& message, const std::string& agent, const hal::Channel& channel);
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

struct Pose {
  using Message = geometry_msgs::msg::dds_::PoseStamped_;
  static constexpr std::string_view kKind = "pose";
  static constexpr std::size_t kValues = 3;
  static void describe(Message& message, const std::string& agent, const hal::Channel& channel);
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

struct Scan {
  using Message = sensor_msgs::msg::dds_::LaserScan_;
  static constexpr std::string_view kKind = "scan";
  static constexpr std::size_t kValues = 0;
  static void describe(Message& message, const std::string& agent, const hal::Channel& channel);
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

struct Sonar {
  using Message = sensor_msgs::msg::dds_::Range_;
  static constexpr std::string_view kKind = "sonar";
  static constexpr std::size_t kValues = 1;
  static void describe(Message& message, const std::string& agent, const hal::Channel& channel);
  static void measure(Message& message, hal::Time at, std::span<const double> values);
};

/// All of these. A kind that is missing here has no topic and is omitted from MCAP files.
using SensorKinds = std::tuple<Battery, Bumper, Imu, Pose, Scan, Sonar>;

/// Calls `on_kind` with an object of the struct above for this kind of channel, if there is one.
template <class OnKind>
void for_kind(std::string_view kind, const OnKind& on_kind) {
  const auto try_one = [&](auto one) {
    if (decltype(one)::kKind == kind) on_kind(one);
  };
  std::apply([&](auto... all) { (try_one(all), ...); }, SensorKinds{});
}

}  // namespace idl::ros
