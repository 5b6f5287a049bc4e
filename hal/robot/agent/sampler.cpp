#include "hal/robot/agent/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "hal/node/devices/channels.h"

namespace hal::robot::agent {
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
  if (devices.pose != nullptr) {
    session.channels.push_back(node::devices::localisation_channel());
  }
  if (devices.wheels != nullptr) {
    session.limits = devices.wheels->limits();
    session.channels.push_back(node::devices::odometry_channel());
  }
  if (devices.infrared != nullptr && file.robot) {
    std::ranges::copy(
        node::devices::infrared_channels(file.robot->infrared, file.infrared->period()),
        std::back_inserter(session.channels));
  }
  if (!devices.sensors.empty())
    std::ranges::copy(sensor_channels(file), std::back_inserter(session.channels));
  return offer;
}

Sampler::Sampler(const RobotFile& file, const Devices& devices)
    : file_(file), devices_(devices), offer_(offer_of(file, devices)) {}

void Sampler::advance(Time) {
  values_.clear();
  if (has_pose()) {
    const LocalisationSettings& settings = file_.localisation;
    if (const auto self = pose(platform::BootClock::now())) {
      values_[node::devices::kLocalisation] =
          relative_positions(*self, file_.address, settings.map, settings.range);
    }
  }
  if (devices_.wheels != nullptr) {
    if (const auto state = devices_.wheels->state()) {
      const auto& [pose, twist, stamp] = *state;
      values_[node::devices::kOdometry] = node::devices::odometry_values(pose, twist);
    }
  }
  for (std::size_t i = 0; i < devices_.sensors.size(); ++i) {
    if (auto latest = devices_.sensors[i]->latest()) values_[id_of(i)] = std::move(latest->values);
  }
  if (devices_.infrared == nullptr) return;
  if (auto latest = devices_.infrared->latest()) {
    values_[node::devices::kInfrared] = std::move(latest->metres);
    values_[node::devices::kInfraredVolts] = std::move(latest->volts);
  }
}

std::uint16_t Sampler::id_of(std::size_t sensor) const {
  return static_cast<std::uint16_t>(node::devices::kFirstSensor + file_.sensors.at(sensor).sensor);
}

bool Sampler::sample(std::size_t channel, Time, std::vector<double>& values) {
  const auto found = values_.find(offer_.session.channels[channel].id);
  if (found == values_.end()) return false;
  values = found->second;
  return true;
}

std::vector<SilentDevice> Sampler::silent(platform::BootTime now) const {
  std::vector<SilentDevice> silent;
  const auto ask = [&](const char* name, const auto& answer, bool wanted) {
    if (!answer) silent.push_back({name, answer.error().message, wanted});
  };
  if (const drivers::WheelDriver* wheels = devices_.wheels) {
    if (std::string trouble = wheels->trouble(); !trouble.empty()) {
      silent.push_back({"wheels", std::move(trouble), false});  // drive() says so itself
    }
    ask("odometry", wheels->state(), wants_.needs("odometry"));
  }
  if (devices_.infrared != nullptr) {
    ask("infrared", devices_.infrared->latest(),
        wants_.needs("infrared") || wants_.needs("infrared_volts"));
  }
  for (std::size_t i = 0; i < devices_.sensors.size(); ++i) {
    const std::string& name = mount_of(file_.robot->sensors.at(file_.sensors.at(i).sensor)).name;
    ask(name.c_str(), devices_.sensors[i]->latest(), wants_.needs(name));
  }
  if (has_pose()) ask("localisation", pose(now), wants_.needs("localisation"));
  return silent;
}

Result<Pose2> Sampler::pose(platform::BootTime now) const {
  const auto fix = devices_.pose->pose();
  if (!fix) return tl::unexpected<Error>(fix.error());
  const auto* topic = std::get_if<PoseTopicSettings>(&file_.localisation.source);
  if (topic != nullptr && now - fix->stamp > topic->stale_after) {
    return fail(Errc::kTimeout,
                fmt::format("no pose for more than {} s", to_seconds(topic->stale_after)));
  }
  return fix->pose;
}

}  // namespace hal::robot::agent
