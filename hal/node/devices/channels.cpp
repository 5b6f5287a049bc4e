#include "hal/node/devices/channels.h"

#include <string>
#include <utility>

namespace hal::node::devices {
namespace {

Channel channel(std::uint16_t id, std::string name, std::string kind, std::string unit) {
  Channel channel;
  channel.id = id;
  channel.name = std::move(name);
  channel.kind = std::move(kind);
  channel.unit = std::move(unit);
  channel.frame = "base";
  return channel;
}

}  // namespace

Channel localisation_channel() {
  return channel(kLocalisation, "localisation", "relative_position", "address, m");
}

Channel odometry_channel() {
  Channel odometry = channel(kOdometry, "odometry", "odometry", "m, rad, m/s");
  odometry.length = static_cast<std::uint32_t>(odometry_values({}, {}).size());
  return odometry;
}

std::array<Channel, 2> infrared_channels(const std::vector<InfraredSensor>& sensors,
                                         Duration period) {
  std::array<Channel, 2> both{channel(kInfrared, "infrared", "range", "m"),
                              channel(kInfraredVolts, "infrared_volts", "voltage", "V")};
  for (Channel& one : both) {
    one.length = static_cast<std::uint32_t>(sensors.size());
    one.period = period;
    for (const InfraredSensor& sensor : sensors) one.headings.push_back(sensor.heading);
  }
  return both;
}

std::vector<Channel> sensor_channels(const std::vector<SensorDescription>& sensors) {
  std::vector<Channel> channels;
  for (const SensorDescription& sensor : sensors) {
    channels.push_back(channel_of(sensor));
    channels.back().id = static_cast<std::uint16_t>(kFirstSensor + channels.size() - 1);
  }
  return channels;
}

std::vector<double> odometry_values(const Pose2& pose, const Twist2& twist) {
  return {pose.x, pose.y, pose.theta, twist.vx, twist.vy, twist.omega};
}

}  // namespace hal::node::devices
