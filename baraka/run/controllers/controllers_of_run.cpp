#include "baraka/run/controllers/controllers_of_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "baraka/run/controllers/missing_controllers_notice.h"
#include "baraka/run/pace/interrupts.h"
#include "gateway/process/exit_status.h"
#include "gateway/process/limits.h"
#include "gateway/runtime/controller_command.h"
#include "gateway/runtime/in_process_controllers.h"
#include "gateway/runtime/plugin.h"
#include "gateway/server/teleop_port.h"

namespace baraka::run::controllers {
namespace {

using sim::scenario::ProcessPlan;
using sim::scenario::Scenario;

constexpr std::uint64_t kOnlyRun = 1;  // a server of `baraka run` serves one run

/// A host restricted to the agents whose controllers are expected.
class ServedAgents final : public hal::node::exchange::AgentHost {
 public:
  ServedAgents(hal::node::exchange::AgentHost& host, InsideControllers& inside)
      : host_(host), inside_(inside) {}

  std::vector<hal::node::exchange::AgentOffer> offers() const override {
    std::vector<hal::node::exchange::AgentOffer> offers = host_.offers();
    std::erase_if(offers, [this](const auto& offer) {
      return offer.program == gateway::server::kTeleop || offer.program.empty() ||
             inside_.is_repeated(offer.session.agent);
    });
    return offers;
  }
  std::vector<hal::node::exchange::AgentName> directory() const override {
    return host_.directory();
  }
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> port,
               const std::vector<hal::AgentId>& agents, const hal::Wants& wants) override {
    inside_.connect_before(agents.front());
    host_.connect(inside_.recorded(std::move(port), agents.front()), agents, wants);
  }

 private:
  hal::node::exchange::AgentHost& host_;
  InsideControllers& inside_;
};

/// Arguments of a controller process.
std::vector<std::string> arguments_for(const ProcessPlan& plan, const Scenario& scenario) {
  // It may wait for the run without limit ("none"), because it ends with this process.
  std::vector<std::string> arguments{"--name", plan.process, "--wait", "none"};
  for (const hal::AgentId agent : plan.agents) {
    const auto config = std::ranges::lower_bound(scenario.simulation.agents, agent, {},
                                                 &sim::agents::AgentConfig::id);  // by address
    arguments.insert(arguments.end(), {"--agents", config->name});
  }
  return arguments;
}

/// @throws UsageError  a controller belongs inside its agent's network, where only a process
/// started
///   by the run can be.
void refuse_inside(const std::vector<ProcessPlan>& plans, ControllersFrom from) {
  const auto inside = std::ranges::find_if(plans, [](const ProcessPlan& p) { return p.inside; });
  if (inside == plans.end() || from == ControllersFrom::kSpawn) return;
  const char* const option = from == ControllersFrom::kExternal ? "external" : "in-process";
  throw gateway::process::UsageError(fmt::format(
      "--controllers {}: '{}' is inside its agent's network, and so a process that the run starts",
      option, inside->process));
}

/// The DDS domain to use; none: the first free one.
std::optional<int> domain_for(const ControllersOfRun::Settings& settings) {
  if (settings.domain || settings.from != ControllersFrom::kExternal) return settings.domain;
  return gateway::process::default_domain();
}

}  // namespace

ControllersOfRun::ControllersOfRun(const Scenario& scenario, sim::agents::Simulation& simulation,
                                   const Settings& settings)
    : simulation_(simulation) {
  std::vector<ProcessPlan> plans = sim::scenario::plan_processes(scenario);
  std::erase_if(plans,
                [](const ProcessPlan& plan) { return plan.program == gateway::server::kTeleop; });
  inside_.emplace(plans, scenario, simulation, settings.replies, settings.repeats_lockstep);
  if (settings.replies != nullptr) {
    std::erase_if(plans, [](const ProcessPlan& plan) { return plan.inside; });
  }
  refuse_inside(plans, settings.from);
  if (plans.empty() && settings.from == ControllersFrom::kExternal) {
    throw gateway::process::UsageError(
        "--controllers external: no agent of this scenario has a controller");
  }
  if (settings.from == ControllersFrom::kInProcess) {
    connect_in_process(plans, simulation);
  } else {
    serve(plans, scenario, simulation, settings);
  }
  inside_->connect_before(hal::kEveryone);
}

ControllersOfRun::~ControllersOfRun() = default;

std::optional<int> ControllersOfRun::domain() const {
  return server_ ? std::optional(server_->domain()) : std::nullopt;
}

void ControllersOfRun::connect_in_process(const std::vector<ProcessPlan>& plans,
                                          sim::agents::Simulation& simulation) {
  const auto offers = simulation.offers();
  for (const ProcessPlan& plan : plans) {
    inside_->connect_before(plan.agents.front());
    const auto connected = gateway::runtime::connect_in_process(
        {.process = plan.process, .program = plan.program, .agents = plan.agents}, offers,
        simulation);
    if (!connected) throw std::runtime_error(connected.error().message);
  }
}

void ControllersOfRun::serve(const std::vector<ProcessPlan>& plans, const Scenario& scenario,
                             sim::agents::Simulation& simulation, const Settings& settings) {
  const bool external = settings.from == ControllersFrom::kExternal;
  served_ = std::make_unique<ServedAgents>(simulation, *inside_);
  server_ = std::make_unique<gateway::server::AgentServer>(
      gateway::process::take_domain(domain_for(settings)), *served_,
      gateway::server::ServerSettings{kOnlyRun, scenario.wait, scenario.reply_timeout});
  fmt::print(stderr, "domain: {}\n", server_->domain());
  if (!external) spawn(plans, scenario, settings);
  std::optional<MissingControllersNotice> notice;
  if (external) notice.emplace(plans, simulation.offers(), server_->domain(), scenario.wait);
  const auto keep_waiting = [&]() -> hal::Result<void> {
    if (pace::interrupted()) return hal::fail(hal::Errc::kNotConnected, "interrupted");
    if (notice) notice->say(server_->missing());
    return check_started(settings);
  };
  if (notice) notice->say(server_->missing());
  if (const auto gathered = server_->gather(keep_waiting); !gathered) {
    const std::string& why = gathered.error().message;
    if (pace::interrupted())
      throw gateway::process::Interrupted(why + " while waiting for controllers");
    throw std::runtime_error(why);
  }
  processes_ = server_->summary().processes.size();
}

hal::Result<void> ControllersOfRun::check_started(const Settings& settings) const {
  if (settings.inside != nullptr) {
    if (auto inside = settings.inside->check(); !inside) return inside;
  }
  return spawner_.check();
}

void ControllersOfRun::spawn(const std::vector<ProcessPlan>& plans, const Scenario& scenario,
                             const Settings& settings) {
  gateway::process::make_room_for(plans.size());
  for (const ProcessPlan& plan : plans) {
    std::vector<std::string> words =
        gateway::runtime::controller_command(plan.program, gateway::runtime::controller_folders());
    if (words.empty()) {
      throw std::runtime_error(
          fmt::format("{}: program: '{}' has no executable", plan.program_place, plan.program));
    }
    std::ranges::move(arguments_for(plan, scenario), std::back_inserter(words));
    if (plan.inside) {
      start_inside(plan, std::move(words), settings);
    } else {
      spawner_.start({.program = words.front(),
                      .arguments = {words.begin() + 1, words.end()},
                      .domain = server_->domain(),
                      .log = settings.logs / (plan.process + ".log"),
                      .name = plan.program});
    }
  }
}

void ControllersOfRun::start_inside(const ProcessPlan& plan, std::vector<std::string> arguments,
                                    const Settings& settings) {
  if (settings.inside == nullptr) {
    throw std::runtime_error(
        fmt::format("{}: program: '{}' is to run inside its agent's network, and there is none",
                    plan.program_place, plan.program));
  }
  if (settings.inside->holds()) return start_held(plan, std::move(arguments), settings);
  const gateway::domain::Invitation invitation = server_->invite();
  settings.inside->start(
      plan.agents.front(),
      {.arguments = std::move(arguments),
       .environment = {invitation.variable(), {"BARAKA_DOMAIN", std::to_string(server_->domain())}},
       .log = settings.logs / (plan.process + ".log"),
       .inherited = invitation.descriptors(),
       .name = plan.program});
}

/// What it is told is the same in all runs; the number of the domain, which it does not use, too.
void ControllersOfRun::start_held(const ProcessPlan& plan, std::vector<std::string> arguments,
                                  const Settings& settings) {
  gateway::server::InsideStarter& starter = *settings.inside;
  const hal::AgentId agent = plan.agents.front();
  gateway::exchange::HeldLink& link =
      server_->expect({.give =
                           [&starter, agent, this](const auto& may_go_on) {
                             starter.give_turns(agent, simulation_.now(), may_go_on);
                           },
                       .now = [this] { return simulation_.now(); }});
  starter.start(agent, {.arguments = std::move(arguments),
                        .environment = {link.variable(), {"BARAKA_DOMAIN", "0"}},
                        .log = settings.logs / (plan.process + ".log"),
                        .inherited = {link.controllers_end()},
                        .name = plan.program});
  link.started();
}

std::vector<std::string> ControllersOfRun::finish(bool stopped, const std::filesystem::path& logs) {
  using namespace std::chrono_literals;
  std::vector<std::string> lines;
  if (!server_) return lines;
  lines = gateway::server::complaints(server_->summary());
  if (!stopped) std::ranges::move(spawner_.killed(logs), std::back_inserter(lines));
  if (stopped) spawner_.wait_all(2s);
  for (const gateway::process::Ending& ending : spawner_.stop_all()) {
    if (stopped && ending.status != 0) {
      lines.push_back(fmt::format("{} (pid {}) {}", ending.name, ending.pid, ending.cause));
    }
  }
  return lines;
}

}  // namespace baraka::run::controllers
