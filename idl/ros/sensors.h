#pragma once

#include <span>
#include <string>
#include <string_view>
#include <tuple>

#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "inspect.h"

namespace idl::ros {

// The message of ROS 2 that each kind of channel has, for a topic of a run under way and for an
// MCAP file alike. describe() writes into a message what does not change from reading to reading;
// measure() writes a reading, of at least kValues values. Infrared and odometry, which are shown
// unasked, are no kinds here.

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

/// All of them. A kind that is missing here has no topic and is left out of MCAP files.
using SensorKinds = std::tuple<Battery, Bumper, Imu, Pose, Scan, Sonar>;

/// Calls `on_kind` with an object of the struct above whose kind the channel has, if there is one.
template <class OnKind>
void for_kind(std::string_view kind, const OnKind& on_kind) {
  const auto try_one = [&](auto one) {
    if (decltype(one)::kKind == kind) on_kind(one);
  };
  std::apply([&](auto... all) { (try_one(all), ...); }, SensorKinds{});
}

}  // namespace idl::ros
