#include "hal/hardware/sampler.h"

#include <algorithm>
#include <span>
#include <utility>
#include <variant>

namespace hal::hardware {
namespace {

// As in the simulator.
constexpr std::uint16_t kLocalisation = 0, kOdometry = 1, kInfrared = 2, kInfraredVolts = 3;
constexpr std::uint32_t kOdometryValues = 6;

Channel channel(std::uint16_t id, std::string name, std::string kind, std::string unit) {
  return {.id = id,
          .name = std::move(name),
          .kind = std::move(kind),
          .unit = std::move(unit),
          .length = 0,
          .period = {},
          .frame = "base",
          .headings = {}};
}

Duration period_of(const RobotFile& file) {
  return std::visit(
      [](const auto& settings) -> Duration {
        if constexpr (requires { settings.times; }) return settings.times.period;
        return {};
      },
      file.infrared);
}

void add_infrared(const RobotFile& file, std::vector<Channel>& channels) {
  channels.push_back(channel(kInfrared, "infrared", "range", "m"));
  channels.push_back(channel(kInfraredVolts, "infrared_volts", "voltage", "V"));
  for (Channel& added : std::span(channels).last(2)) {
    added.length = static_cast<std::uint32_t>(file.robot->infrared.size());
    added.period = period_of(file);
    for (const auto& sensor : file.robot->infrared) added.headings.push_back(sensor.heading);
  }
}

}  // namespace

exchange::AgentOffer offer_of(const RobotFile& file, const Devices& devices) {
  exchange::AgentOffer offer;
  offer.program = file.program;
  exchange::AgentSession& session = offer.session;
  session.agent = file.address;
  session.name = file.name;
  session.kind = file.kind;
  session.seed = file.seed;
  session.control_period = file.control_period;
  session.parameters = file.parameters;
  if (devices.pose != nullptr) {
    session.channels.push_back(
        channel(kLocalisation, "localisation", "relative_position", "address, m"));
  }
  if (devices.wheels != nullptr) {
    session.limits = devices.wheels->limits();
    session.channels.push_back(channel(kOdometry, "odometry", "odometry", "m, rad, m/s"));
    session.channels.back().length = kOdometryValues;
  }
  if (devices.infrared != nullptr && file.robot) add_infrared(file, session.channels);
  return offer;
}

void Sampler::set_wants(const Wants& wants) {
  localisation_ = devices_.pose != nullptr && wants.asks_for("localisation");
  odometry_ = devices_.wheels != nullptr && wants.asks_for("odometry");
  infrared_ = devices_.infrared != nullptr && wants.asks_for("infrared");
  volts_ = devices_.infrared != nullptr && wants.asks_for("infrared_volts");
}

Sampler::Sample Sampler::take(SteadyTime now) const {
  Sample sample;
  if (localisation_) sample.readings.push_back(localisation(now));
  if (odometry_) take_odometry(sample);
  if (infrared_ || volts_) take_infrared(sample);
  return sample;
}

std::optional<Pose2> Sampler::pose(SteadyTime now) const {
  if (devices_.pose == nullptr) return std::nullopt;
  const auto fix = devices_.pose->pose();
  if (!fix) return std::nullopt;
  const auto* topic = std::get_if<PoseTopicSettings>(&file_.localisation.source);
  if (topic != nullptr && now - fix->stamp > topic->stale_after) return std::nullopt;
  return fix->pose;
}

/// Empty without a fix: nobody is localised then.
exchange::Reading Sampler::localisation(SteadyTime now) const {
  exchange::Reading reading{.channel = kLocalisation, .values = {}};
  if (const auto self = pose(now)) {
    reading.values =
        relative_positions(*self, file_.address, file_.localisation.map, file_.localisation.range);
  }
  return reading;
}

/// Dead reckoning that is not there leaves the last one standing.
void Sampler::take_odometry(Sample& sample) const {
  const auto state = devices_.wheels->state();
  if (!state) return;
  const auto& [pose, twist, stamp] = *state;
  sample.readings.push_back(
      {kOdometry, {pose.x, pose.y, pose.theta, twist.vx, twist.vy, twist.omega}});
}

void Sampler::take_infrared(Sample& sample) const {
  auto readings = devices_.infrared->latest();
  if (!readings) {
    sample.blind_because = readings.error().message;
    return;
  }
  if (infrared_) sample.readings.push_back({kInfrared, std::move(readings->metres)});
  if (volts_) sample.readings.push_back({kInfraredVolts, std::move(readings->volts)});
}

}  // namespace hal::hardware
