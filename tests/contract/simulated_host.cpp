#include <chrono>
#include <cmath>
#include <thread>

#include "gateway/server.h"
#include "hal/dds/domains.h"
#include "hal/dds/waiting.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/scenario.h"
#include "tests/contract/contract_host.h"
#include "tests/support/test_domain.h"

namespace contract {
namespace {

using namespace std::chrono_literals;
using sim::agents::Simulation;

/// Sees states, and whether the robot moves from one control instant to the next.
class SightObserver final : public sim::agents::Observer {
 public:
  explicit SightObserver(Sight& sight) : sight_(sight) {}
  void on_state(hal::Time, hal::AgentId agent, std::string_view state) override {
    sight_.on_state(agent, std::string(state));
  }
  void on_body(hal::Time, hal::AgentId agent, const sim::agents::BodyState& body) override {
    if (agent != kRobot) return;
    constexpr double kStanding = 1e-5;  // m in 20 ms: 0.5 mm/s
    sight_.on_wheels(std::hypot(body.x - last_.x, body.y - last_.y) > kStanding);
    last_ = body;
  }

 private:
  Sight& sight_;
  sim::agents::BodyState last_;
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
    if (left > 0ns) hal::dds::wait_readable(descriptors, std::min<hal::Duration>(left, 50ms));
    return !stop_;
  }

 private:
  const std::atomic<bool>& stop_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class SimulatedHost final : public ContractHost {
 public:
  explicit SimulatedHost(bool lock_step)
      : scenario_(sim::scenario::load_scenario(TESTS_DIR "/contract/contract.yaml", {})),
        simulation_(scenario_.simulation, {&observer_}),
        server_(hal::dds::take_domain(test_domain()), simulation_, {.run = 1}),
        thread_([this, lock_step] { run(lock_step); }) {}
  ~SimulatedHost() override { end(); }

  int domain() const override { return server_.domain(); }
  const Sight& sight() const override { return sight_; }
  std::uint64_t end() override {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
    return lost_;
  }

 private:
  void run(bool lock_step) {
    const auto keep_waiting = [this]() -> hal::Result<void> {
      if (stop_) return hal::fail(hal::Errc::kNotConnected, "the test is over");
      return {};
    };
    if (!server_.gather(keep_waiting)) return;
    Stoppable pace(stop_);
    if (lock_step) {
      simulation_.run(std::nullopt, pace);
    } else {
      lost_ = simulation_.follow(std::nullopt, pace).real_time->lost_events;
    }
  }

  Sight sight_;
  SightObserver observer_{sight_};
  std::atomic<bool> stop_ = false;
  std::uint64_t lost_ = 0;  ///< Of the thread until it has ended.
  sim::scenario::Scenario scenario_;
  Simulation simulation_;
  gateway::AgentServer server_;
  std::thread thread_;
};

}  // namespace

Implementation simulator_in_lock_step() {
  return {"SimulatorInLockStep", {.waits_for_answers = true}, [] {
            return std::make_unique<SimulatedHost>(true);
          }};
}

Implementation simulator_in_real_time() {
  return {"SimulatorInRealTime", {}, [] { return std::make_unique<SimulatedHost>(false); }};
}

}  // namespace contract
