#include "hal/robot/agent/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "hal/node/devices/channels.h"
#include "hal/node/devices/robot_outline.h"

namespace hal::robot::agent {
namespace {

Result<Pose2> pose_of(const RobotFile& file, const PoseSource& source, platform::BootTime now) {
  const auto fix = source.pose();
  if (!fix) return tl::unexpected<Error>(fix.error());
  const auto* topic = std::get_if<PoseTopicSettings>(&file.localisation.source);
  if (topic != nullptr && now - fix->stamp > topic->stale_after) {
    return fail(Errc::kTimeout,
                fmt::format("no pose for more than {} s", to_seconds(topic->stale_after)));
  }
  return fix->pose;
}

}  // namespace

std::vector<DevicePart> parts_of(const RobotFile& file, const Devices& devices) {
  using Values = DevicePart::Values;
  std::vector<DevicePart> parts;
  const auto add = [&](std::vector<Channel> channels, auto ask, auto values) {
    parts.push_back(
        {std::move(channels), [=](platform::BootTime now) { return ask(now).map(values); }});
  };
  if (const PoseSource* pose = devices.pose) {
    add(
        {node::devices::localisation_channel()},
        [&file, pose](auto now) { return pose_of(file, *pose, now); },
        [&file](const Pose2& self) {
          const LocalisationSettings& settings = file.localisation;
          return Values{relative_positions(self, file.address, settings.map, settings.range)};
        });
  }
  if (const drivers::WheelDriver* wheels = devices.wheels) {
    add(
        {node::devices::odometry_channel()}, [wheels](auto) { return wheels->state(); },
        [](const auto& at) { return Values{node::devices::odometry_values(at.pose, at.twist)}; });
  }
  if (const auto* infrared = devices.infrared; infrared != nullptr && file.robot) {
    const auto [metres, volts] =
        node::devices::infrared_channels(file.robot->infrared, file.infrared->period());
    add(
        {metres, volts}, [infrared](auto) { return infrared->latest(); },
        [](const auto& reading) {
          return Values{reading.metres, reading.volts};
        });
  }
  const std::vector<Channel> channels = sensor_channels(file);
  for (std::size_t i = 0; i < devices.sensors.size(); ++i) {
    add(
        {channels.at(i)}, [sensor = devices.sensors[i]](auto) { return sensor->latest(); },
        [](const auto& reading) { return Values{reading.values}; });
  }
  return parts;
}

node::exchange::AgentOffer offer_of(const RobotFile& file, const Devices& devices) {
  node::exchange::AgentOffer offer;
  offer.program = file.program;
  node::exchange::AgentSession& session = offer.session;
  session.agent = file.address;
  session.name = file.name;
  session.kind = file.kind;
  session.seed = file.seed;
  session.control_period = file.control_period;
  session.parameters = file.parameters;
  session.air_interface = file.air_interface;
  if (devices.wheels != nullptr) session.limits = devices.wheels->limits();
  if (file.robot) session.body = node::devices::body_of(*file.robot);
  for (const DevicePart& part : parts_of(file, devices))
    std::ranges::copy(part.channels, std::back_inserter(session.channels));
  return offer;
}

Sampler::Sampler(const RobotFile& file, const Devices& devices)
    : file_(file),
      devices_(devices),
      parts_(parts_of(file, devices)),
      offer_(offer_of(file, devices)) {}

void Sampler::advance(Time) {
  values_.clear();
  for (const DevicePart& part : parts_) {
    auto latest = part.latest(platform::BootClock::now());
    for (std::size_t i = 0; i < part.channels.size(); ++i) {
      values_.push_back(latest ? std::optional(std::move((*latest)[i])) : std::nullopt);
    }
  }
}

bool Sampler::sample(std::size_t channel, Time, std::vector<double>& values) {
  if (channel >= values_.size() || !values_[channel]) return false;
  values = *values_[channel];
  return true;
}

std::vector<SilentDevice> Sampler::silent(platform::BootTime now) const {
  std::vector<SilentDevice> silent;
  if (const drivers::WheelDriver* wheels = devices_.wheels) {
    if (std::string trouble = wheels->trouble(); !trouble.empty()) {
      silent.push_back({"wheels", std::move(trouble), false});  // drive() itself reports that
    }
  }
  for (const DevicePart& part : parts_) {
    const auto is_needed = [&](const Channel& channel) { return wants_.needs(channel.name); };
    if (const auto latest = part.latest(now); !latest) {
      silent.push_back({part.channels.front().name, latest.error().message,
                        std::ranges::any_of(part.channels, is_needed)});
    }
  }
  return silent;
}

Result<Pose2> Sampler::pose(platform::BootTime now) const {
  return pose_of(file_, *devices_.pose, now);
}

}  // namespace hal::robot::agent
