#include "hal/hardware/sampler.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "hal/devices/channels.h"

namespace hal::hardware {
namespace {

Duration period_of(const RobotFile& file) {
  return std::visit(
      [](const auto& settings) -> Duration {
        if constexpr (requires { settings.times; }) return settings.times.period;
        return {};
      },
      file.infrared);
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
    session.channels.push_back(devices::localisation_channel());
  }
  if (devices.wheels != nullptr) {
    session.limits = devices.wheels->limits();
    session.channels.push_back(devices::odometry_channel());
  }
  if (devices.infrared != nullptr && file.robot) {
    std::ranges::copy(devices::infrared_channels(file.robot->infrared, period_of(file)),
                      std::back_inserter(session.channels));
  }
  return offer;
}

void Sampler::set_wants(const Wants& wants) {
  wants_ = wants;
  localisation_ = devices_.pose != nullptr && wants.asks_for("localisation");
  odometry_ = devices_.wheels != nullptr && wants.asks_for("odometry");
  infrared_ = devices_.infrared != nullptr && wants.asks_for("infrared");
  volts_ = devices_.infrared != nullptr && wants.asks_for("infrared_volts");
}

std::vector<exchange::Reading> Sampler::take(BootTime now) const {
  std::vector<exchange::Reading> readings;
  if (localisation_) readings.push_back(localisation(now));
  if (odometry_) readings.push_back(odometry());
  if (infrared_ || volts_) take_infrared(readings);
  return readings;
}

std::vector<SilentDevice> Sampler::silent(BootTime now) const {
  std::vector<SilentDevice> silent;
  const auto ask = [&](const char* name, const auto& answer, bool wanted) {
    if (!answer) silent.push_back({name, answer.error().message, wanted});
  };
  if (const WheelDriver* wheels = devices_.wheels) {
    if (std::string trouble = wheels->trouble(); !trouble.empty()) {
      silent.push_back({"wheels", std::move(trouble), false});  // drive() says so itself
    }
    ask("odometry", wheels->state(), wants_.needs("odometry"));
  }
  if (devices_.infrared != nullptr) {
    ask("infrared", devices_.infrared->latest(),
        wants_.needs("infrared") || wants_.needs("infrared_volts"));
  }
  if (has_pose()) ask("localisation", pose(now), wants_.needs("localisation"));
  return silent;
}

Result<Pose2> Sampler::pose(BootTime now) const {
  const auto fix = devices_.pose->pose();
  if (!fix) return tl::unexpected<Error>(fix.error());
  const auto* topic = std::get_if<PoseTopicSettings>(&file_.localisation.source);
  if (topic != nullptr && now - fix->stamp > topic->stale_after) {
    return fail(Errc::kTimeout,
                fmt::format("no pose for more than {} s", to_seconds(topic->stale_after)));
  }
  return fix->pose;
}

exchange::Reading Sampler::localisation(BootTime now) const {
  const auto self = pose(now);
  if (!self) return {.channel = devices::kLocalisation, .values = {}, .lost = true};
  const LocalisationSettings& settings = file_.localisation;
  return {.channel = devices::kLocalisation,
          .values = relative_positions(*self, file_.address, settings.map, settings.range)};
}

exchange::Reading Sampler::odometry() const {
  const auto state = devices_.wheels->state();
  if (!state) return {.channel = devices::kOdometry, .values = {}, .lost = true};
  const auto& [pose, twist, stamp] = *state;
  return {.channel = devices::kOdometry, .values = devices::odometry_values(pose, twist)};
}

void Sampler::take_infrared(std::vector<exchange::Reading>& readings) const {
  auto latest = devices_.infrared->latest();
  const bool lost = !latest;
  InfraredReadings all = lost ? InfraredReadings{} : std::move(*latest);
  if (infrared_) readings.push_back({devices::kInfrared, std::move(all.metres), lost});
  if (volts_) readings.push_back({devices::kInfraredVolts, std::move(all.volts), lost});
}

}  // namespace hal::hardware
