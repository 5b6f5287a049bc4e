#include "baraka/run/topics/run_inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gateway/server/teleop_port.h"
#include "hal/types/terminal_colours.h"

namespace baraka::run::topics {
namespace {

bool has_teleop(const sim::scenario::Scenario& scenario) {
  return std::ranges::any_of(scenario.groups,
                             [](const auto& g) { return g.program == gateway::server::kTeleop; });
}

/// Requests all channels of an agent, so that they can be published.
hal::Wants all_channels(const hal::node::exchange::AgentOffer& offer) {
  hal::Wants wants;
  for (const hal::Channel& channel : offer.session.channels) wants.channels.push_back(channel.name);
  return wants;
}

}  // namespace

RunInspection::RunInspection(const sim::scenario::Scenario& scenario, const Settings& settings)
    : scenario_(scenario), settings_(settings), observer_(scenario.simulation) {}

void RunInspection::start(std::optional<int> domain_of_run, sim::agents::Simulation& simulation) {
  const std::optional<int> domain = settings_.domain ? settings_.domain : domain_of_run;
  const bool teleop = has_teleop(scenario_);
  const bool hears = teleop && !settings_.repeated;
  if (!domain && hears) {
    throw std::runtime_error(
        "teleop needs a DDS domain, and a run with its controllers in process has none: "
        "--inspect-domain N");
  }
  if (domain && (settings_.shown || hears)) {
    try {
      open(*domain);
    } catch (const std::runtime_error& e) {
      // Not required, so only a warning.
      if (settings_.domain || hears) throw;
      hal::print_line(hal::Tone::kWarning,
                      fmt::format("warning: the run is not shown: {}", e.what()));
    }
  }
  if (teleop) connect_teleop(simulation);
}

void RunInspection::open(int domain) {
  participant_ = std::make_unique<gateway::inspection::InspectionParticipant>(
      gateway::inspection::InspectionParticipant::Settings{.domain = domain, .name = "baraka run"});
  if (settings_.shown) observer_.start(*participant_);
  fmt::print(stderr, "inspect domain: {}\n", domain);
}

void RunInspection::connect_teleop(sim::agents::Simulation& simulation) {
  for (const hal::node::exchange::AgentOffer& offer : simulation.offers()) {
    if (offer.program != gateway::server::kTeleop) continue;
    const auto velocities =
        std::make_shared<TeleopVelocities>(simulation.outside(), offer.session.name);
    if (!settings_.repeated) driven_[offer.session.agent] = velocities;
    if (!settings_.repeated) velocities->listen(*participant_);
    simulation.connect(std::make_shared<gateway::server::TeleopPort>(
                           offer.session.name, [velocities] { return velocities->last(); },
                           scenario_.simulation.command_timeout, offer.session.control_period),
                       {offer.session.agent}, all_channels(offer));
  }
}

bool RunInspection::drive(hal::AgentId agent, const hal::Twist2& twist) {
  const auto velocities = driven_.find(agent);
  if (velocities == driven_.end()) return false;
  velocities->second->put(twist);
  return true;
}

}  // namespace baraka::run::topics
