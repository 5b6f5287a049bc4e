#include "sim/agents/senses.h"

#include <utility>
#include <variant>

#include "hal/node/devices/channels.h"
#include "hal/types/check.h"
#include "sim/agents/agent_offer.h"
#include "sim/sensing/infrared.h"
#include "sim/sensing/relative_localisation.h"
#include "sim/sensing/sensors.h"

namespace sim::agents {
namespace {

using hal::node::devices::RobotDescription;
using hal::node::devices::Sensor;

/// Sensor of the surrounding agents; it needs the Scene, which sim/sensing cannot include.
class Localisation final : public Sensor {
 public:
  Localisation(hal::AgentId agent, Scene& scene, double range)
      : agent_(agent), scene_(scene), range_(range) {}

  hal::Channel describe() const override { return hal::node::devices::localisation_channel(); }

  std::optional<std::vector<double>> sample(hal::Time at) override {
    const BodyState self = scene_.body(agent_, at);
    std::vector<double> values;
    for (const auto& other : sensing::localise({self.x, self.y, self.theta}, agent_,
                                               scene_.near({self.x, self.y}, range_, at), range_)) {
      values.insert(values.end(),
                    {static_cast<double>(other.agent.value), other.position.x, other.position.y});
    }
    return values;
  }

 private:
  hal::AgentId agent_;
  Scene& scene_;
  double range_;  ///< m
};

}  // namespace

Senses::Senses(const AgentConfig& agent, Scene& scene, double range,
               const sensing::SensorSite& site) {
  add(std::make_unique<Localisation>(agent.id, scene, range));
  if (const auto* robot = std::get_if<RobotDescription>(&agent.body)) add_robot(*robot, site);
  for (const auto& sensor : sensors_of(agent)) add(sensing::make_sensor(sensor, site));

  const std::vector<hal::Channel> channels = channels_of(agent);
  BARAKA_CHECK(parts_.size() == channels.size());
  for (std::size_t i = 0; i < channels.size(); ++i)
    BARAKA_CHECK(parts_[i].sensor->describe().name == channels[i].name);
}

void Senses::add_robot(const RobotDescription& robot, const sensing::SensorSite& site) {
  auto odometry = std::make_unique<sensing::Odometry>(site, robot.encoder_steps);
  odometry_ = odometry.get();
  add(std::move(odometry));
  if (robot.infrared.empty()) return;
  for (auto& channel : sensing::simulated(robot.infrared, site)) add(std::move(channel));
}

void Senses::add(std::unique_ptr<Sensor> sensor) { parts_.push_back({std::move(sensor), {}}); }

const std::vector<double>& Senses::read(std::size_t channel, hal::Time at) {
  Part& part = parts_.at(channel);
  if (auto fresh = part.sensor->sample(at)) part.held = std::move(*fresh);
  return part.held;
}

}  // namespace sim::agents
