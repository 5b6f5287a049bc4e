#include "python/simulator/episode.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <future>
#include <stdexcept>
#include <thread>
#include <utility>

#include "gateway/runtime/in_process_controllers.h"
#include "hal/files/config/shared_folders.h"
#include "python/simulator/driven_port.h"
#include "python/simulator/hand_over.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/core/fingerprint.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/scenario.h"

namespace python::simulator {
namespace {

using hal::node::exchange::AgentSession;
using sim::agents::Simulation;
using sim::scenario::Scenario;

/// Where the driven robots are.
class Places final : public sim::agents::Observer {
 public:
  void on_body(hal::Time /*at*/, hal::AgentId agent, const sim::agents::BodyState& body) override {
    bodies_[agent] = body;
  }
  void add_to(std::vector<AgentView>& views, const std::vector<AgentSession>& sessions) const {
    for (std::size_t i = 0; i < views.size(); ++i) {
      const auto found = bodies_.find(sessions[i].agent);
      if (found == bodies_.end()) continue;
      const sim::agents::BodyState& body = found->second;
      views[i].pose = {body.x, body.y, body.theta};
      views[i].clearance = body.clearance;
    }
  }

 private:
  std::map<hal::AgentId, sim::agents::BodyState> bodies_;
};

/// As fast as can be, until the user has enough.
class UntilClosed final : public sim::agents::Pace {
 public:
  explicit UntilClosed(HandOver& hand_over) : hand_over_(hand_over) {}
  Verdict may_go_on(hal::Time, const sim::agents::Progress&) override {
    return hand_over_.is_closed() ? Verdict::kBreakOff : Verdict::kGoOn;
  }

 private:
  HandOver& hand_over_;
};

Scenario scenario_of(const std::string& file, std::vector<std::string> overrides) {
  overrides.emplace_back("control_phase=aligned");
  const std::filesystem::path found = hal::files::config::named_file(file, {"scenarios"});
  Scenario scenario = sim::scenario::load_scenario(found, overrides);
  for (const sim::agents::AgentConfig& agent : scenario.simulation.agents) {
    if (agent.network) {
      throw std::runtime_error(fmt::format(
          "{}: agent {} has a network for programs, which an environment does not start", file,
          agent.name));
    }
  }
  return scenario;
}

std::vector<hal::AgentId> robots_called(const Scenario& scenario,
                                        const std::vector<std::string>& names) {
  std::vector<hal::AgentId> found;
  for (const std::string& name : names) {
    const auto& agents = scenario.simulation.agents;
    const auto agent = std::ranges::find(agents, name, &sim::agents::AgentConfig::name);
    if (agent == agents.end()) {
      throw std::runtime_error(fmt::format("agents: '{}' is not in the scenario", name));
    }
    if (!sim::agents::is_robot(*agent)) {
      throw std::runtime_error(fmt::format("agents: '{}' is no robot", name));
    }
    if (std::ranges::find(found, agent->id) != found.end()) {
      throw std::runtime_error(fmt::format("agents: '{}' is named twice", name));
    }
    found.push_back(agent->id);
  }
  if (found.empty()) throw std::runtime_error("agents: names none");
  return found;
}

const hal::node::exchange::AgentOffer& offer_for(
    const std::vector<hal::node::exchange::AgentOffer>& offers, hal::AgentId agent) {
  return *std::ranges::find_if(offers,
                               [agent](const auto& offer) { return offer.session.agent == agent; });
}

/// The controllers of all agents but the driven ones.
void connect_others(const Scenario& scenario, Simulation& simulation,
                    const std::vector<hal::AgentId>& driven) {
  const auto offers = simulation.offers();
  for (sim::scenario::ProcessPlan& plan : sim::scenario::plan_processes(scenario)) {
    std::erase_if(plan.agents,
                  [&](hal::AgentId id) { return std::ranges::find(driven, id) != driven.end(); });
    if (plan.agents.empty()) continue;
    const auto connected = gateway::runtime::connect_in_process(
        {.process = plan.process, .program = plan.program, .agents = plan.agents}, offers,
        simulation);
    if (!connected) throw std::runtime_error(connected.error().message);
  }
}

}  // namespace

/// The simulation and its thread, on which it is made, runs and ends: ODE keeps data by thread.
class Episode::Run {
 public:
  Run(Scenario scenario, std::vector<hal::AgentId> driven, std::optional<hal::Time> until)
      : scenario_(std::move(scenario)), driven_(std::move(driven)), until_(until) {
    thread_ = std::thread([this] { live(); });
    try {
      made_.get_future().get();
    } catch (...) {
      thread_.join();
      throw;
    }
  }
  ~Run() { end(); }
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  const std::vector<AgentSession>& sessions() const { return sessions_; }
  HandOver& hand_over() { return hand_over_; }
  void begin() {
    if (!has_begun_.exchange(true)) begun_.set_value();
  }
  void end() {
    hand_over_.close();
    begin();
    const std::lock_guard only_one(ending_);
    if (thread_.joinable()) thread_.join();
  }

 private:
  void live() {
    sim::agents::FingerprintFeed feed;
    Places places;
    std::unique_ptr<Simulation> simulation;
    std::shared_ptr<DrivenPort> port;
    try {
      simulation = std::make_unique<Simulation>(
          scenario_.simulation, std::vector<sim::agents::Observer*>{&feed, &places});
      port = connect(*simulation, places);
    } catch (...) {
      made_.set_exception(std::current_exception());
      return;
    }
    made_.set_value();
    begun_.get_future().wait();
    play(*simulation, feed, [&](Situation& last) {
      last.agents = port->views();
      places.add_to(last.agents, sessions_);
    });
  }

  std::shared_ptr<DrivenPort> connect(Simulation& simulation, const Places& places) {
    const auto offers = simulation.offers();
    hal::Wants wants;
    for (const hal::AgentId agent : driven_) {
      sessions_.push_back(offer_for(offers, agent).session);
      for (const hal::Channel& one : sessions_.back().channels) {
        if (!wants.asks_for(one.name)) wants.optional.push_back(one.name);
      }
    }
    auto port = std::make_shared<DrivenPort>(sessions_, [this, &places](Situation situation) {
      places.add_to(situation.agents, sessions_);
      return hand_over_.ask(std::move(situation));
    });
    simulation.connect(port, driven_, wants);
    connect_others(scenario_, simulation, driven_);
    return port;
  }

  template <class Look>
  void play(Simulation& simulation, sim::agents::FingerprintFeed& feed, Look look) {
    Situation last;
    std::string error;
    try {
      UntilClosed pace(hand_over_);
      const sim::agents::Outcome outcome = simulation.run(until_, pace);
      feed.finish();
      last.now = outcome.ended_at;
      last.ended = true;
      last.result = outcome.result;
      last.fingerprint = sim::to_hex(feed.fingerprint().total());
      look(last);
      error = outcome.error;
    } catch (const std::exception& failed) {
      error = failed.what();
    }
    hand_over_.finish(std::move(last), std::move(error));
  }

  const Scenario scenario_;
  const std::vector<hal::AgentId> driven_;
  const std::optional<hal::Time> until_;
  HandOver hand_over_;
  std::vector<AgentSession> sessions_;
  std::promise<void> made_, begun_;
  std::atomic<bool> has_begun_ = false;
  std::mutex ending_;
  std::thread thread_;
};

Episode::Episode(const std::string& file, const std::vector<std::string>& overrides,
                 const std::vector<std::string>& agents, std::optional<hal::Time> until)
    : process_(getpid()) {
  Scenario scenario = scenario_of(file, overrides);
  std::vector<hal::AgentId> driven = robots_called(scenario, agents);
  run_ = std::make_unique<Run>(std::move(scenario), std::move(driven), until);
  sessions_ = run_->sessions();
}

Episode::~Episode() {
  // A forked process has the memory of the run, but neither its thread nor locks that it can trust.
  if (getpid() != process_) [[maybe_unused]]
    Run* const others = run_.release();
}

void Episode::end() {
  if (getpid() == process_) run_->end();
}

std::unique_lock<std::mutex> Episode::take_turn() {
  if (getpid() != process_) {
    throw std::runtime_error(
        fmt::format("the episode is one of process {}, from which this one was forked", process_));
  }
  std::unique_lock turn(turn_, std::try_to_lock);
  if (!turn) throw std::runtime_error("another thread drives the episode");
  return turn;
}

Situation Episode::begin() {
  const auto turn = take_turn();
  if (state_ != State::kNew) throw std::runtime_error("the episode has begun already");
  run_->begin();
  return next();
}

Situation Episode::advance(const std::vector<hal::Twist2>& drives) {
  const auto turn = take_turn();
  if (state_ == State::kNew) throw std::runtime_error("the episode has not begun");
  if (state_ == State::kEnded) throw std::runtime_error("the episode has ended");
  if (drives.size() != sessions_.size()) {
    throw std::runtime_error(
        fmt::format("{} robots are driven, not {}", sessions_.size(), drives.size()));
  }
  run_->hand_over().answer(drives);
  return next();
}

Situation Episode::next() {
  state_ = State::kEnded;  // unless the run gives another situation
  Situation situation = run_->hand_over().next();
  if (!situation.ended) state_ = State::kRunning;
  return situation;
}

}  // namespace python::simulator
