#include "sim/agents/simulated_mote.h"

#include "hal/devices/channels.h"
#include "hal/types/random.h"
#include "sim/agents/agent_offer.h"

namespace sim::agents {

SimulatedMote::SimulatedMote(const AgentConfig& config, radio::MacSap& mac,
                             Surroundings surroundings, hal::agent::AgentListener& listener,
                             hal::agent::Drive* drive)
    : config_(config),
      surroundings_(surroundings),
      id_(config.id),
      link_(mac, surroundings.config.link),
      timers_(surroundings.events, config.id),
      core_(offer_of(config, surroundings.config).session, surroundings.config.routing,
            {.timers = timers_,
             .link = link_,
             .drive = drive,
             .sensors = *this,
             .observer = surroundings.observer,
             .listener = listener}) {
  link_.attach(core_.router());
}

void SimulatedMote::start() {
  EventQueue& events = surroundings_.events;
  hal::Time first{};
  if (surroundings_.config.control_phase == ControlPhase::kUniform) {
    hal::RandomStream random(surroundings_.config.seed, name() + "/control");
    const double period = hal::to_seconds(surroundings_.config.control_period);
    first += hal::from_seconds(random.uniform() * period);
  }
  events.schedule(first, Rank::kScenario, id(), [this] { core_.start(); });
  events.schedule(first, Rank::kControl, id(), [this] { on_control(); });
}

void SimulatedMote::on_control() {
  const hal::Time now = surroundings_.events.now();
  surroundings_.observer.on_body(now, id(), surroundings_.scene.body(id()));
  core_.control();
  surroundings_.events.schedule(now + surroundings_.config.control_period, Rank::kControl, id(),
                                [this] { on_control(); });
}

void SimulatedMote::silence(hal::Time stop_at) {
  if (!core_.is_connected()) return;
  core_.disconnect();
  surroundings_.events.schedule(stop_at, Rank::kAction, id(), [this] { core_.halt(); });
}

bool SimulatedMote::sample(std::size_t channel, hal::Time, std::vector<double>& values) {
  if (core_.session().channels[channel].id == hal::devices::kLocalisation) localise(values);
  return true;
}

void SimulatedMote::localise(std::vector<double>& values) {
  const BodyState self = surroundings_.scene.body(id());
  const double range = surroundings_.config.localisation.range.value;
  for (const auto& other :
       sensing::localise({self.x, self.y, self.theta}, id(),
                         surroundings_.scene.near({self.x, self.y}, range), range)) {
    values.insert(values.end(),
                  {static_cast<double>(other.agent.value), other.position.x, other.position.y});
  }
}

}  // namespace sim::agents
