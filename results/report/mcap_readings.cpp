// Sensor readings for an MCAP file: from the table `readings` or, for agents and channels without
// readings, from observables.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "idl/ros/sensors.h"
#include "idl/ros/values.h"
#include "results/report/mcap_streams.h"

namespace results::report {
namespace {

constexpr std::size_t kOdometryValues = 6;
constexpr std::array<std::string_view, kOdometryValues> kOdometryNames{"x",  "y",  "yaw",
                                                                       "vx", "vy", "omega"};

/// Values of a reading such as "0.31 - 0.5"; "-" (nothing within range) becomes NaN.
std::vector<double> values_of(const std::string& reading) {
  std::vector<double> values;
  const char* at = reading.data();
  const char* const end = at + reading.size();
  while (at < end) {
    if (*at == ' ') {
      ++at;
      continue;
    }
    double value = std::numeric_limits<double>::quiet_NaN();
    const auto [rest, error] = std::from_chars(at, end, value);
    values.push_back(value);
    at = error == std::errc() ? rest : at + 1;
  }
  return values;
}

void publish_odometry(const McapParts& parts, std::int64_t at, const std::string& name,
                      std::span<const double> v) {
  if (v.size() < kOdometryValues) return;
  nav_msgs::msg::dds_::Odometry_ odometry;
  odometry.header().stamp(idl::ros::to_ros(hal::time_from_ns(at)));
  odometry.header().frame_id(name + "/odom");
  odometry.child_frame_id(name + "/base_link");
  odometry.pose().pose(idl::ros::to_ros(hal::Pose2{v[0], v[1], v[2]}));
  odometry.twist().twist(idl::ros::to_ros(hal::Twist2{v[3], v[4], v[5]}));
  parts.topics.publish(at, "/" + name + "/odom", odometry);
}

void publish_infrared(const McapParts& parts, std::int64_t at, std::int64_t agent,
                      std::size_t sensor, double metres) {
  const auto of = parts.scene.agents.find(agent);
  if (of == parts.scene.agents.end() || sensor >= of->second.ranges.size()) return;
  const ExportedRange& range = of->second.ranges[sensor];
  const std::string name = parts.name(agent);
  sensor_msgs::msg::dds_::Range_ message;
  message.header().stamp(idl::ros::to_ros(hal::time_from_ns(at)));
  message.header().frame_id(name + "/infrared_" + std::to_string(sensor));
  message.radiation_type(idl::ros::kInfrared);
  message.field_of_view(static_cast<float>(range.field_of_view));
  message.min_range(static_cast<float>(range.low));
  message.max_range(static_cast<float>(range.high));
  message.range(idl::ros::to_ros_distance(metres));
  parts.topics.publish(at, "/" + name + "/range", message);
}

/// Publishes a reading of a sensor of `sensors:`, with the message type that a running simulation
/// uses for its kind.
void publish_sensor(const McapParts& parts, std::int64_t at, const std::string& agent,
                    const hal::Channel& channel, std::span<const double> values) {
  if (channel.length != 0 && values.size() != channel.length) return;
  idl::ros::for_kind(channel.kind, [&](auto one) {
    using Kind = decltype(one);
    if (values.size() < Kind::kValues) return;
    typename Kind::Message message;
    Kind::describe(message, agent, channel);
    Kind::measure(message, hal::time_from_ns(at), values);
    parts.topics.publish(at, "/" + agent + "/" + channel.name, message);
  });
}

void on_reading(const McapParts& parts, std::int64_t at, const record::Statement& row) {
  const std::int64_t agent = row.integer(1);
  const std::string channel = row.text(2), name = parts.name(agent);
  const std::vector<double> values = values_of(row.text(3));
  if (channel == "odometry") return publish_odometry(parts, at, name, values);
  if (channel == "infrared") {
    for (std::size_t i = 0; i < values.size(); ++i)
      publish_infrared(parts, at, agent, i, values[i]);
    return;
  }
  const auto of = parts.scene.agents.find(agent);
  if (of == parts.scene.agents.end()) return;
  const auto known = std::ranges::find(of->second.channels, channel, &hal::Channel::name);
  if (known == of->second.channels.end()) return;
  publish_sensor(parts, at, name, *known, values);
}

/// Odometry assembled from observables, each of which holds its value until the next sample.
/// Published once every component has a value.
class HeldOdometry {
 public:
  void set(std::int64_t agent, std::string_view value_name, double value) {
    for (std::size_t i = 0; i < kOdometryValues; ++i) {
      if (kOdometryNames[i] != value_name) continue;
      held_[agent][i] = value;
      touched_.insert(agent);
    }
  }
  void publish(const McapParts& parts, std::int64_t at) {
    for (const std::int64_t agent : touched_) {
      std::vector<double> values;
      for (const auto& value : held_[agent]) {
        if (value) values.push_back(*value);
      }
      publish_odometry(parts, at, parts.name(agent), values);
    }
    touched_.clear();
  }

 private:
  std::map<std::int64_t, std::array<std::optional<double>, kOdometryValues>> held_;
  std::set<std::int64_t> touched_;
};

constexpr std::string_view kOdometry = "sensors.odometry.", kInfrared = "sensors.infrared.";

std::optional<std::size_t> number_of(std::string_view text) {
  std::size_t number = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || rest != text.data() + text.size()) return std::nullopt;
  return number;
}

/// Adds the observables of agents and channels without readings.
void add_observable_stream(const McapParts& parts, McapStreams& streams) {
  const auto odometry = std::make_shared<HeldOdometry>();
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "WITH read AS MATERIALIZED (SELECT DISTINCT agent, channel FROM readings),"
      " wanted AS MATERIALIZED (SELECT observable, agent, name FROM observables o"
      " WHERE (name GLOB 'sensors.odometry.*' OR name GLOB 'sensors.infrared.*')"
      " AND NOT EXISTS (SELECT 1 FROM read r WHERE r.agent = o.agent"
      " AND o.name GLOB 'sensors.' || r.channel || '.*'))"
      " SELECT s.at_ns, w.agent, w.name, s.value FROM observable_samples s"
      " JOIN wanted w USING (observable) ORDER BY s.at_ns, w.observable",
      [parts, odometry](std::int64_t at, const record::Statement& row) {
        const std::string name = row.text(2);
        if (name.starts_with(kOdometry)) {
          odometry->set(row.integer(1), std::string_view(name).substr(kOdometry.size()),
                        row.real(3));
        } else if (const auto sensor = number_of(std::string_view(name).substr(kInfrared.size()))) {
          publish_infrared(parts, at, row.integer(1), *sensor, row.real(3));
        }
      },
      [parts, odometry](std::int64_t at) { odometry->publish(parts, at); }));
}

}  // namespace

void add_reading_streams(const McapParts& parts, McapStreams& streams) {
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, channel, reading FROM readings ORDER BY at_ns, agent",
      [parts](std::int64_t at, const record::Statement& row) { on_reading(parts, at, row); }));
  add_observable_stream(parts, streams);
}

}  // namespace results::report
