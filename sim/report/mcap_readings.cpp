// What agents sensed, for an MCAP file: from the readings that were recorded or, of those agents
// that have none, from observables.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "sim/report/mcap_streams.h"
#include "sim/report/ros_messages.h"

namespace sim::report {
namespace {

constexpr std::size_t kOdometryValues = 6;
constexpr std::array<std::string_view, kOdometryValues> kOdometryNames{"x",  "y",  "yaw",
                                                                       "vx", "vy", "omega"};

/// "0.31 - 0.5": "-" is nothing within reach.
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
  parts.topics.publish(
      at, "/" + name + "/odom", "nav_msgs/msg/Odometry",
      odometry({at, name + "/odom"}, name + "/base_link", {v[0], v[1], v[2]}, {v[3], v[4], v[5]}));
}

void publish_infrared(const McapParts& parts, std::int64_t at, std::int64_t agent,
                      std::size_t sensor, double metres) {
  const auto of = parts.scene.agents.find(agent);
  if (of == parts.scene.agents.end() || sensor >= of->second.ranges.size()) return;
  const ExportedRange& range = of->second.ranges[sensor];
  const std::string name = parts.name(agent);
  parts.topics.publish(at, "/" + name + "/range", "sensor_msgs/msg/Range",
                       range_message({.header = {at, name + "/infrared_" + std::to_string(sensor)},
                                      .is_infrared = true,
                                      .field_of_view = range.field_of_view,
                                      .low = range.low,
                                      .high = range.high,
                                      .range = metres}));
}

std::string sonar_message(const RosHeader& header, const hal::Channel& channel, double metres) {
  const bool has_edges = channel.headings.size() == 2;
  return range_message({.header = header,
                        .is_infrared = false,
                        .field_of_view = has_edges ? channel.headings[1] - channel.headings[0] : 0,
                        .low = channel.low,
                        .high = channel.high,
                        .range = metres});
}

std::string scan_message(const RosHeader& header, const hal::Channel& channel,
                         std::vector<double> ranges) {
  const std::vector<double>& headings = channel.headings;
  return laser_scan({.header = header,
                     .first = headings.empty() ? 0 : headings.front(),
                     .last = headings.empty() ? 0 : headings.back(),
                     .step = headings.size() > 1 ? headings[1] - headings[0] : 0,
                     .period = hal::to_seconds(channel.period),
                     .low = channel.low,
                     .high = channel.high,
                     .ranges = std::move(ranges)});
}

/// A reading of a sensor of `sensors:`, on a topic with its name.
void publish_sensor(const McapParts& parts, std::int64_t at, const std::string& name,
                    const hal::Channel& channel, std::vector<double> values) {
  if (channel.length != 0 && values.size() != channel.length) return;
  const std::string topic = "/" + name + "/" + channel.name;
  const RosHeader header{at, name + "/" + channel.frame};
  if (channel.kind == "scan") {
    parts.topics.publish(at, topic, "sensor_msgs/msg/LaserScan",
                         scan_message(header, channel, std::move(values)));
  } else if (channel.kind == "sonar") {
    parts.topics.publish(at, topic, "sensor_msgs/msg/Range",
                         sonar_message(header, channel, values[0]));
  } else if (channel.kind == "bumper") {
    parts.topics.publish(at, topic, "std_msgs/msg/Bool", bool_message(values[0] != 0));
  } else if (channel.kind == "pose") {
    parts.topics.publish(at, topic, "geometry_msgs/msg/PoseStamped",
                         pose_stamped({at, "world"}, {values[0], values[1], values[2]}));
  }
}

void on_reading(const McapParts& parts, std::int64_t at, const record::Statement& row) {
  const std::int64_t agent = row.integer(1);
  const std::string channel = row.text(2), name = parts.name(agent);
  std::vector<double> values = values_of(row.text(3));
  if (channel == "odometry") return publish_odometry(parts, at, name, values);
  if (channel == "infrared") {
    for (std::size_t i = 0; i < values.size(); ++i)
      publish_infrared(parts, at, agent, i, values[i]);
    return;
  }
  const auto of = parts.scene.agents.find(agent);
  if (of == parts.scene.agents.end()) return;
  for (const hal::Channel& known : of->second.channels) {
    if (known.name == channel) publish_sensor(parts, at, name, known, std::move(values));
  }
}

/// Odometry from single values, each held until the next: all of them from the instant on at which
/// there is the last of them.
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

/// @param but_not  agents and channels that have readings, as SQL after WHERE
void add_observable_stream(const McapParts& parts, McapStreams& streams,
                           const std::string& but_not) {
  const auto odometry = std::make_shared<HeldOdometry>();
  streams.push_back(std::make_unique<McapStream>(
      parts.reader,
      "SELECT s.at_ns, o.agent, o.name, s.value FROM observable_samples s"
      " JOIN observables o USING (observable) WHERE (o.name GLOB 'sensors.odometry.*'"
      " OR o.name GLOB 'sensors.infrared.*')" +
          but_not + " ORDER BY s.at_ns, o.observable",
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
  bool has_readings = false;
  {
    record::Statement table = parts.reader.query(
        "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'readings'");
    has_readings = table.next();
  }
  if (!has_readings) return add_observable_stream(parts, streams, "");
  streams.push_back(std::make_unique<McapStream>(
      parts.reader, "SELECT at_ns, agent, channel, reading FROM readings ORDER BY at_ns, agent",
      [parts](std::int64_t at, const record::Statement& row) { on_reading(parts, at, row); }));
  add_observable_stream(parts, streams,
                        " AND NOT EXISTS (SELECT 1 FROM readings r WHERE r.agent = o.agent"
                        " AND o.name GLOB 'sensors.' || r.channel || '.*')");
}

}  // namespace sim::report
