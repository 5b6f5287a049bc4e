#include "sim/agents/simulated_mote.h"

#include <utility>
#include <variant>

#include "hal/devices/channels.h"
#include "hal/types/random.h"
#include "sim/agents/agent_offer.h"
#include "sim/sensing/sensors.h"

namespace sim::agents {
namespace {

namespace devices = hal::devices;

hal::routing::RoutingConfig routing_of(const AgentConfig& agent, const SimulationConfig& config) {
  hal::routing::RoutingConfig routing = config.routing;
  routing.algorithm = agent.routing.value_or(routing.algorithm);
  return routing;
}

}  // namespace

double energy(const radio::RadioUse& use, const devices::RadioPower& power) {
  return power.transmit * hal::to_seconds(use.transmitting) +
         power.receive * hal::to_seconds(use.receiving) +
         power.listen * hal::to_seconds(use.listening) + power.off * hal::to_seconds(use.off);
}

SimulatedMote::SimulatedMote(const AgentConfig& config, radio::MacSap& mac,
                             Surroundings surroundings, hal::agent::AgentListener& listener,
                             hal::agent::Drive* drive)
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
             .listener = listener}) {
  link_.attach(core_.router());
  if (!sensors_of(config).empty()) add_sensors(mac);
}

void SimulatedMote::add_sensors(radio::MacSap& mac) {
  const sensing::SensorSite site{
      id(),
      name(),
      surroundings_.config.seed,
      surroundings_.world,
      [&scene = surroundings_.scene]() -> const sensing::Proximity& { return scene.proximity(); },
      [&mac](const devices::RadioPower& power) { return energy(mac.use(), power); }};
  sensing::SensorSite of_first_battery = site;
  of_first_battery.taken_energy = [this] { return taken_energy_; };
  for (const devices::SensorDescription& sensor : sensors_of(config_)) {
    const auto* battery = std::get_if<devices::Battery>(&sensor);
    if (battery != nullptr && battery->when_empty == devices::WhenEmpty::kOff)
      cutting_ = sensors_.size();
    const bool is_first = battery != nullptr && !battery_;
    if (is_first) battery_ = sensors_.size();
    sensors_.push_back({sensing::make_sensor(sensor, is_first ? of_first_battery : site), {}});
  }
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
    if (cutting_ && read(sensors_[*cutting_], now).front() <= 0) cut_power();
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
  core_.halt();  // what the dead one had commanded
  link_.set_radio(true);
  core_.connect(wants);
  core_.start();
}

void SimulatedMote::cut_power() {
  cutting_.reset();
  is_empty_ = true;
  link_.cut_power();
  power_motors();
}

void SimulatedMote::set_power(bool on) {
  is_on_ = on;
  link_.set_power(is_on_ && is_present_);
  power_motors();
}

void SimulatedMote::power_motors() { set_motors(is_on_ && is_present_ && !is_empty_); }

void SimulatedMote::set_present(bool present) {
  if (present == is_present_) return;
  if (!present) kept_charge_ = charge();
  const hal::Time now = surroundings_.events.now();
  absence_ = absence(now);
  absent_since_ = now;
  is_present_ = present;
  if (present && kept_charge_) drain((charge().value_or(0) - *kept_charge_) * capacity());
  set_power(present || is_on_);
}

std::optional<double> SimulatedMote::charge() {
  if (!battery_) return std::nullopt;
  return read(sensors_[*battery_], surroundings_.events.now()).front();
}

void SimulatedMote::drain(double joules) { taken_energy_ += joules; }

double SimulatedMote::capacity() const {
  return std::get<devices::Battery>(sensors_of(config_)[*battery_]).capacity;
}

bool SimulatedMote::sample(std::size_t channel, hal::Time at, std::vector<double>& values) {
  const std::uint16_t id = core_.session().channels[channel].id;
  if (id == devices::kLocalisation) localise(at, values);
  if (id >= devices::kFirstSensor) values = read(sensors_.at(id - devices::kFirstSensor), at);
  return true;
}

const std::vector<double>& SimulatedMote::read(Part& part, hal::Time at) {
  if (auto fresh = part.sensor->sample(at)) part.held = std::move(*fresh);
  return part.held;
}

void SimulatedMote::localise(hal::Time at, std::vector<double>& values) {
  const BodyState self = surroundings_.scene.body(id(), at);
  const double range = surroundings_.config.localisation.range.value;
  for (const auto& other :
       sensing::localise({self.x, self.y, self.theta}, id(),
                         surroundings_.scene.near({self.x, self.y}, range, at), range)) {
    values.insert(values.end(),
                  {static_cast<double>(other.agent.value), other.position.x, other.position.y});
  }
}

}  // namespace sim::agents
