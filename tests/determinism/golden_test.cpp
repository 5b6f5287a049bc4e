#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gateway/runtime/controller_host.h"
#include "gateway/runtime/in_process_port.h"
#include "gateway/runtime/plugin.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/scenario.h"
#include "tests/support/no_pace.h"

namespace {

using namespace std::chrono_literals;
using sim::agents::Simulation;
using sim::scenario::Scenario;

void connect_in_process(const Scenario& scenario, Simulation& simulation) {
  std::map<hal::AgentId, hal::node::exchange::AgentOffer> offers;
  for (const auto& offer : simulation.offers()) offers[offer.session.agent] = offer;
  for (const auto& plan : sim::scenario::plan_processes(scenario)) {
    const auto kind = gateway::runtime::load_plugin(plan.program, {BIN_DIR});
    ASSERT_TRUE(kind) << kind.error().message;
    hal::node::exchange::Session session;
    for (const hal::AgentId agent : plan.agents) {
      session.agents.push_back(
          hal::node::exchange::session_for(offers.at(agent), (*kind)->wants).value());
    }
    auto host = gateway::runtime::ControllerHost::create(**kind, session);
    ASSERT_TRUE(host) << host.error().message;
    simulation.connect(
        std::make_shared<gateway::runtime::InProcessPort>(plan.process, std::move(*host)),
        plan.agents, (*kind)->wants);
  }
}

/// "air … bodies … exchange … routing …" of a run's first minute.
std::string fingerprint(const std::string& profile, int seed) {
  const Scenario scenario =
      sim::scenario::load_scenario(CONFIG_DIR "/scenarios/case_study.yaml",
                                   {fmt::format("seed={}", seed), "radio.profile=" + profile});
  sim::agents::FingerprintFeed feed;
  Simulation simulation(scenario.simulation, {&feed});
  connect_in_process(scenario, simulation);
  tests::NoPace pace;
  simulation.run(hal::Time{60s}, pace);
  std::string line = fmt::format("{} seed {}:", profile, seed);
  for (int p = 0; p < sim::kPartCount; ++p) {
    const auto part = static_cast<sim::Part>(p);
    line += fmt::format(" {} {}", sim::name(part), sim::to_hex(feed.fingerprint().part(part)));
  }
  return line;
}

// The same bits in every build: this test runs in release, and in debug under the sanitizers. If it
// fails and the change was meant, run
//   UPDATE_GOLDEN=1 ./test -R Golden
// and commit the new file on its own, saying in the message what moved and why.
TEST(Golden, TheFirstMinuteOfTheCaseStudyHasTheSameFingerprintsAsEver) {
  std::vector<std::string> lines;
  for (const int seed : {1, 2, 3}) lines.push_back(fingerprint("mobility_framework", seed));
  for (const char* profile : {"ieee80211b", "disk", "ideal"}) {
    lines.push_back(fingerprint(profile, 1));
  }
  const std::string path = TESTS_DIR "/golden/case_study.txt";
  if (std::getenv("UPDATE_GOLDEN") != nullptr) {
    std::ofstream out(path);
    for (const std::string& line : lines) out << line << '\n';
  }
  std::ifstream in(path);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string expected;
    ASSERT_TRUE(std::getline(in, expected)) << path << " ends at line " << i;
    EXPECT_EQ(lines[i], expected) << "at " << path << ":" << i + 1;
  }
}

}  // namespace
