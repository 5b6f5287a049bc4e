#include "sim/agents/simulated_mote.h"

#include "hal/node/devices/sensors.h"
#include "hal/types/log.h"
#include "hal/types/random.h"
#include "sim/agents/agent_offer.h"

namespace sim::agents {
namespace {

namespace devices = hal::node::devices;

hal::node::routing::RoutingConfig routing_of(const AgentConfig& agent,
                                             const SimulationConfig& config) {
  hal::node::routing::RoutingConfig routing = config.routing;
  routing.algorithm = agent.routing.value_or(routing.algorithm);
  routing.statics = {.rows = {}, .routes = agent.static_routes};
  return routing;
}

}  // namespace

SimulatedMote::SimulatedMote(const AgentConfig& config, radio::MacSap& mac,
                             Surroundings surroundings, hal::node::agent::AgentListener& listener,
                             hal::node::agent::Drive* drive)
    : config_(config),
      surroundings_(surroundings),
      id_(config.id),
      link_(mac, surroundings.config.link),
      timers_(surroundings.events, config.id),
      core_(offer_of(config, surroundings.config).session, routing_of(config, surroundings.config),
            {.timers = timers_,
             .link = link_,
             .drive = drive,
             .sensors = *this,
             .observer = surroundings.observer,
             .listener = listener}),
      senses_(config, surroundings.scene, surroundings.config.localisation.range.value, site()),
      mac_(mac) {
  link_.attach(core_.router());
  if (devices::battery_of(sensors_of(config)) != nullptr) add_supply();
}

SimulatedMote::~SimulatedMote() {
  if (supply_ != nullptr) mac_.set_use_listener(nullptr);
}

void SimulatedMote::add_supply() {
  supply_ = std::make_unique<Supply>(*devices::battery_of(sensors_of(config_)),
                                     surroundings_.events, id_, [this] { on_empty(); });
  mac_.set_use_listener(supply_.get());
}

sensing::SensorSite SimulatedMote::site() {
  return {
      id(),
      name(),
      surroundings_.config.seed,
      surroundings_.world,
      [&scene = surroundings_.scene]() -> const sensing::Proximity& { return scene.proximity(); },
      [this] { return supply_->battery(); }};
}

void SimulatedMote::start() {
  EventQueue& events = surroundings_.events;
  hal::Time first{};
  if (surroundings_.config.control_phase == ControlPhase::kUniform) {
    hal::RandomStream random(surroundings_.config.seed, name() + "/control");
    const double period = hal::to_seconds(surroundings_.config.control_period);
    first += hal::from_seconds(random.uniform() * period);
  }
  if (!config_.is_present) set_present(false);
  events.schedule(first, Rank::kScenario, id(), [this] {
    if (is_present_) core_.start();
  });
  events.schedule(first, Rank::kControl, id(), [this] { on_control(); });
}

void SimulatedMote::on_control() {
  const hal::Time now = surroundings_.events.now();
  if (is_present_) {
    surroundings_.observer.on_body(now, id(), surroundings_.scene.body(id(), now));
    core_.control();
  }
  surroundings_.events.schedule(now + surroundings_.config.control_period, Rank::kControl, id(),
                                [this] { on_control(); });
}

void SimulatedMote::silence(hal::Time stop_at) {
  if (!core_.is_connected()) return;
  core_.disconnect();
  stop_ = surroundings_.events.schedule(stop_at, Rank::kAction, id(), [this] { core_.halt(); });
}

void SimulatedMote::begin_anew(const hal::Wants& wants) {
  surroundings_.events.cancel(stop_);
  core_.halt();  // cancels the commands of the previous controller
  link_.set_radio(true);
  core_.connect(wants);
  core_.start();
}

void SimulatedMote::on_empty() {
  hal::log::info(surroundings_.events.now(), name(), "its battery is empty: it is off");
  link_.cut_power();
  power_motors();
}

void SimulatedMote::set_power(bool on) {
  is_on_ = on;
  link_.set_power(is_on_ && is_present_);
  power_motors();
}

void SimulatedMote::power_motors() {
  set_motors(is_on_ && is_present_ && (supply_ == nullptr || !supply_->is_spent()));
}

void SimulatedMote::set_present(bool present) {
  if (present == is_present_) return;
  is_present_ = present;
  if (supply_ != nullptr) supply_->set_present(present);
  set_power(present || is_on_);
}

bool SimulatedMote::is_fed(const hal::Channel& channel) const {
  return supply_ == nullptr || !supply_->is_spent() || channel.kind == devices::Battery::kKind;
}

bool SimulatedMote::sample(std::size_t channel, hal::Time at, std::vector<double>& values) {
  if (!is_fed(core_.session().channels[channel])) return false;
  values = senses_.read(channel, at);
  return true;
}

}  // namespace sim::agents
