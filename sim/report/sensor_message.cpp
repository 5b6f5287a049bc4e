#include "sim/report/sensor_message.h"

#include <algorithm>
#include <array>

#include "sim/report/ros_messages.h"

namespace sim::report {
namespace {

struct SensorReading {
  std::int64_t at_ns;
  const std::string& agent;
  const hal::Channel& channel;
  std::span<const double> values;

  RosHeader header() const { return {at_ns, agent + "/" + channel.frame}; }
};

std::string scan_of(const SensorReading& reading) {
  const hal::Channel& channel = reading.channel;
  const std::vector<double>& headings = channel.headings;
  return laser_scan({.header = reading.header(),
                     .first = headings.empty() ? 0 : headings.front(),
                     .last = headings.empty() ? 0 : headings.back(),
                     .step = headings.size() > 1 ? headings[1] - headings[0] : 0,
                     .period = hal::to_seconds(channel.period),
                     .low = channel.low,
                     .high = channel.high,
                     .ranges = {reading.values.begin(), reading.values.end()}});
}

std::string sonar_of(const SensorReading& reading) {
  const hal::Channel& channel = reading.channel;
  const bool has_edges = channel.headings.size() == 2;
  return range_message({.header = reading.header(),
                        .is_infrared = false,
                        .field_of_view = has_edges ? channel.headings[1] - channel.headings[0] : 0,
                        .low = channel.low,
                        .high = channel.high,
                        .range = reading.values[0]});
}

std::string bumper_of(const SensorReading& reading) { return bool_message(reading.values[0] != 0); }

std::string pose_of(const SensorReading& reading) {
  const auto v = reading.values;
  return pose_stamped({reading.at_ns, "world"}, {v[0], v[1], v[2]});
}

std::string imu_of(const SensorReading& reading) {
  const auto v = reading.values;
  return imu_message(reading.header(), {v[0], v[1], v[2]}, {v[3], v[4], v[5]});
}

std::string battery_of(const SensorReading& reading) {
  const auto v = reading.values;
  return battery_state({reading.at_ns, reading.agent + "/base_link"},
                       {.charge = v[0], .volts = v[1], .drawn_amperes = v[2]});
}

struct SensorKind {
  std::string_view name;
  std::string_view type;
  std::size_t values;  ///< At least.
  std::string (*make)(const SensorReading& reading);
};

constexpr std::array kKinds{
    SensorKind{"scan", "sensor_msgs/msg/LaserScan", 0, scan_of},
    SensorKind{"sonar", "sensor_msgs/msg/Range", 1, sonar_of},
    SensorKind{"bumper", "std_msgs/msg/Bool", 1, bumper_of},
    SensorKind{"pose", "geometry_msgs/msg/PoseStamped", 3, pose_of},
    SensorKind{"imu", "sensor_msgs/msg/Imu", 6, imu_of},
    SensorKind{"battery", "sensor_msgs/msg/BatteryState", 3, battery_of},
};

}  // namespace

std::optional<SensorMessage> sensor_message(std::int64_t at_ns, const std::string& agent,
                                            const hal::Channel& channel,
                                            std::span<const double> values) {
  const auto kind = std::ranges::find(kKinds, channel.kind, &SensorKind::name);
  if (kind == kKinds.end() || values.size() < kind->values) return std::nullopt;
  if (channel.length != 0 && values.size() != channel.length) return std::nullopt;
  return SensorMessage{kind->type, kind->make({at_ns, agent, channel, values})};
}

}  // namespace sim::report
