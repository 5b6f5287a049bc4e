#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <thread>

#include "gateway/process/domains.h"
#include "gateway/process/waiting.h"
#include "gateway/server/server.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"
#include "tests/contract/contract_host.h"
#include "tests/support/test_domain.h"

namespace contract {
namespace {

using namespace std::chrono_literals;
using sim::agents::Simulation;

const std::vector<std::string> kAsItIs;  // the scenario

/// Sees states, and how fast the robot moves from one control instant to the next.
class SightObserver final : public sim::agents::Observer {
 public:
  explicit SightObserver(Sight& sight) : sight_(sight) {}
  void on_state(hal::Time, hal::AgentId agent, std::string_view state) override {
    sight_.on_state(agent, std::string(state));
  }
  void on_record(hal::Time, hal::AgentId agent, std::string_view name, double value) override {
    sight_.on_record(agent, std::string(name), value);
  }
  bool observes_readings() const override { return true; }
  bool observes(hal::AgentId, const hal::Channel& channel) const override {
    return channel.kind == "range";
  }
  void on_reading(hal::Time, hal::AgentId agent, const hal::Channel&,
                  std::span<const double>) override {
    sight_.on_range(agent);
  }
  void on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) override {
    if (agent != kRobot) return;
    const double moved = std::hypot(body.x - last_.x, body.y - last_.y);
    if (at > last_at_) sight_.on_speed(moved / hal::to_seconds(at - last_at_));
    last_ = body;
    last_at_ = at;
  }

 private:
  Sight& sight_;
  sim::agents::BodyState last_;
  hal::Time last_at_{};
};

/// Ends a run when it is told to, on either way of going on.
class Stoppable final : public sim::agents::Pace, public sim::agents::FollowedClock {
 public:
  explicit Stoppable(const std::atomic<bool>& stop) : stop_(stop) {}

  Verdict may_go_on(hal::Time, const sim::agents::Progress&) override {
    return stop_ ? Verdict::kBreakOff : Verdict::kGoOn;
  }
  hal::Time now() override { return hal::Time{std::chrono::steady_clock::now() - start_}; }
  bool wait(hal::Time until, std::span<const int> descriptors,
            const sim::agents::Progress&) override {
    const hal::Duration left = until - now();
    if (left > 0ns)
      gateway::process::wait_readable(descriptors, std::min<hal::Duration>(left, 50ms));
    return !stop_;
  }

 private:
  const std::atomic<bool>& stop_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class SimulatedHost final : public ContractHost {
 public:
  SimulatedHost(bool lock_step, std::optional<int> domain,
                const std::vector<std::string>& overrides)
      : scenario_(sim::scenario::load_scenario(TESTS_DIR "/contract/contract.yaml", overrides)),
        simulation_(scenario_.simulation, {&observer_}) {
    if (domain) {
      server_.emplace(gateway::process::take_domain(*domain), simulation_,
                      gateway::server::ServerSettings{.run = 1});
    }
    thread_ = std::thread([this, lock_step] { run(lock_step); });
  }
  ~SimulatedHost() override { end(); }

  std::optional<int> domain() const override {
    return server_ ? std::optional(server_->domain()) : std::nullopt;
  }
  const Sight& sight() const override { return sight_; }
  hal::node::exchange::DriveLimits limits() const override {
    return simulation_.offers().front().session.limits;
  }
  void connect(std::shared_ptr<hal::node::exchange::ControllerPort> controller, hal::AgentId agent,
               const hal::Wants& wants) override {
    const std::lock_guard lock(mutex_);
    simulation_.connect(std::move(controller), {agent}, wants);
    ++connected_;
  }
  std::vector<hal::node::exchange::AgentName> directory(hal::AgentId) const override {
    return simulation_.directory();
  }
  End end() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return end_;
  }

 private:
  /// @returns false if the test is over first.
  bool gather() {
    if (server_) {
      const auto keep_waiting = [this]() -> hal::Result<void> {
        if (stop_) return hal::fail(hal::Errc::kNotConnected, "the test is over");
        return {};
      };
      return server_->gather(keep_waiting).has_value();
    }
    const auto is_complete = [this] {
      const std::lock_guard lock(mutex_);
      return connected_ == scenario_.simulation.agents.size();
    };
    while (!stop_ && !is_complete()) std::this_thread::sleep_for(1ms);
    return !stop_;
  }

  void run(bool lock_step) {
    if (!gather()) return;
    Stoppable pace(stop_);
    const sim::agents::Outcome outcome =
        lock_step ? simulation_.run(std::nullopt, pace) : simulation_.follow(std::nullopt, pace);
    end_ = {outcome.real_time ? outcome.real_time->lost_events : 0, outcome.refused_actions};
  }

  Sight sight_;
  SightObserver observer_{sight_};
  std::atomic<bool> stop_ = false;
  End end_;  ///< Of the thread until it has ended.
  sim::scenario::Scenario scenario_;
  Simulation simulation_;
  std::optional<gateway::server::AgentServer> server_;
  std::mutex mutex_;
  std::size_t connected_ = 0;  ///< Agents, in process.
  std::thread thread_;
};

}  // namespace

Implementation simulator_in_lock_step() {
  return {"SimulatorInLockStep", {.waits_for_answers = true, .senses_the_world = true}, [] {
            return std::make_unique<SimulatedHost>(true, test_domain(), kAsItIs);
          }};
}

Implementation simulator_in_real_time() {
  return {"SimulatorInRealTime", {.senses_the_world = true}, [] {
            return std::make_unique<SimulatedHost>(false, test_domain(), kAsItIs);
          }};
}

Implementation simulator_in_process() {
  return {"SimulatorInProcess", {.waits_for_answers = true, .senses_the_world = true}, [] {
            return std::make_unique<SimulatedHost>(
                true, std::nullopt, std::vector<std::string>{"controller_latency=10 ms"});
          }};
}

}  // namespace contract
