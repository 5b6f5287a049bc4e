#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "results/record/recorder.h"
#include "results/report/report.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/agents/simulation.h"
#include "sim/radio/radio_rules.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/scenario.h"
#include "tests/support/no_pace.h"
#include "tests/support/scripted_port.h"
#include "tests/unit/extension/foreign.h"
#include "tests/unit/results/record/test_run.h"
#include "view/server/radio_range.h"
#include "view/server/run.h"

/// A law of propagation, a radio profile and a routing protocol that no list of the product knows
/// are classified, and named in records, reports and the view, as they say themselves.
namespace tests {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::node::exchange::Action;
using hal::node::exchange::Cause;
using hal::node::exchange::Event;
using hal::node::exchange::Send;
using results::record::test::ask;
using sim::scenario::Scenario;

constexpr AgentId kA{1}, kB{2};
constexpr const char* kScenario = R"(
version: 1
name: extended
end: [{at: 3 s, result: done}]
record: {frames: all, messages: all, routes: all, pose_period: 250 ms}
radio: {profile: ieee80211b}
agents:
  m:
    mote: {model: brick, size: [1 cm, 1 cm, 1 cm], mass: 1 g}
    poses: [{x: 0 m, y: 0 m}, {x: 40 m, y: 0 m}]
    controller: {program: help_mote}
)";

/// When it starts, a sends a message to b.
std::vector<Action> one_message(const Event& event) {
  if (event.agent != kA || event.cause() != Cause::kStart) return {};
  return {{.what = Send{.id = 1, .destination = kB, .topic = "test", .payload = {}}}};
}

class Extension : public testing::Test {
 protected:
  Extension() : folder_(testing::UnitTest::GetInstance()->current_test_info()->name()) {
    const auto file = folder_.path() / "scenario.yaml";
    std::ofstream(file) << kScenario;
    scenario = sim::scenario::load_scenario(file);
  }

  sim::radio::WavesConfig& waves() { return *waves_of(scenario.simulation.radio); }

  /// The results of a run, as `baraka run` leaves them.
  std::filesystem::path run(const std::string& name = "result") {
    auto folder = folder_.path() / name;
    std::filesystem::create_directories(folder);
    results::record::Recorder recorder(folder / results::record::kResultsFile, scenario.simulation,
                                       {.pose_period = scenario.record.pose_period,
                                        .frames = scenario.record.frames,
                                        .messages = scenario.record.messages,
                                        .routes = scenario.record.routes});
    recorder.add_settings(sim::scenario::resolved_values(scenario));
    recorder.set("scenario", scenario.name);
    recorder.set("run_id", name);
    std::ofstream(folder / "scenario.resolved.yaml") << sim::scenario::resolved_yaml(scenario);
    sim::agents::FingerprintFeed feed;
    sim::agents::Simulation simulation(scenario.simulation, {&recorder, &feed});
    simulation.connect(std::make_shared<ScriptedPort>(one_message), {kA, kB}, {});
    NoPace pace;
    const auto outcome = simulation.run(hal::Time{2s}, pace);
    feed.finish();
    recorder.finish(outcome, feed.fingerprint());
    return folder;
  }

  static std::string asked(const std::filesystem::path& folder, const std::string& sql) {
    return results::record::test::ask(folder / results::record::kResultsFile, sql);
  }
  static std::string setting(const std::filesystem::path& folder, const std::string& key) {
    return asked(folder, "SELECT value FROM settings WHERE key = '" + key + "'");
  }
  static std::string report(const std::vector<std::filesystem::path>& folders) {
    return results::report::report(results::report::read_sources(folders), std::nullopt);
  }
  static bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  Scenario scenario;

 private:
  results::record::test::Folder folder_;
};

TEST_F(Extension, AForeignLawIsOfTheKindItSays) {
  using sim::radio::FriisConfig;
  using sim::radio::RayleighConfig;
  EXPECT_TRUE(sim::radio::is_law_of_distance(kTestLaw));
  EXPECT_FALSE(sim::radio::is_fading(kTestLaw));
  EXPECT_FALSE(sim::radio::is_law_of_distance(kTestFading));
  EXPECT_TRUE(sim::radio::is_fading(kTestFading));
  const auto is_accepted = [&](std::vector<sim::radio::PathLossConfig> chain) {
    waves().propagation.chain = std::move(chain);
    try {
      check(scenario.simulation.radio);
      return true;
    } catch (const std::invalid_argument&) {
      return false;
    }
  };
  EXPECT_TRUE(is_accepted({kTestLaw}));
  EXPECT_TRUE(is_accepted({kTestLaw, RayleighConfig{}}));
  EXPECT_TRUE(is_accepted({FriisConfig{}, kTestFading}));
  EXPECT_FALSE(is_accepted({kTestLaw, FriisConfig{}}));
  EXPECT_FALSE(is_accepted({kTestFading}));
  EXPECT_FALSE(is_accepted({FriisConfig{}, kTestFading, RayleighConfig{}}));
}

// 16.0206 dBm (40 mW) less 60 dB and, at 40 m, 16.0206 dB: -60 dBm. The law of distance holds at
// the start of a link and its reach in the view: 40 mW * 1e-6 / 10^-8.2 mW = 6339.57 m, computed
// with bc.
TEST_F(Extension, AForeignLawActsAndIsNamed) {
  const auto before = run("friis");
  waves().propagation.chain = {kTestLaw, kTestFading};
  const auto faded = run("faded");
  EXPECT_EQ(setting(faded, "radio.propagation.0.model"), "test_law");
  EXPECT_EQ(setting(faded, "radio.propagation.1.model"), "test_fading");
  EXPECT_EQ(asked(faded, "SELECT ROUND(MIN(rssi_dbm), 3) FROM frame_ends WHERE agent = 2"),
            "-63.01");
  waves().propagation.chain = {kTestLaw};
  const auto folder = run("law");
  EXPECT_EQ(asked(folder, "SELECT ROUND(MIN(rssi_dbm), 3) FROM frame_ends WHERE agent = 2"),
            "-60.0");
  const std::string text = report({before, folder});
  EXPECT_TRUE(has(text, "test_law")) << text;
  EXPECT_TRUE(has(text, "power_law")) << text;
  const auto range =
      view::server::radio_range(scenario.simulation, scenario.simulation.agents.front());
  EXPECT_NEAR(range.value_or(0), 6339.57, 0.01);
}

TEST_F(Extension, AForeignProfileIsNamedInRecordReportAndView) {
  scenario.simulation.radio = test_profile();
  EXPECT_EQ(profile_name(scenario.simulation.radio), "test_profile");
  EXPECT_NE(waves_of(scenario.simulation.radio), nullptr);
  EXPECT_EQ(dcf_of(scenario.simulation.radio), nullptr);
  const auto folder = run();
  EXPECT_EQ(asked(folder, "SELECT value FROM run WHERE key = 'profile'"), "test_profile");
  EXPECT_EQ(setting(folder, "radio.profile"), "test_profile");
  EXPECT_EQ(setting(folder, "radio.tx_power"), "2 mW");
  EXPECT_EQ(asked(folder, "SELECT COUNT(*) FROM deliveries"), "1") << "its MAC carries messages";
  const std::string text = report({folder});
  EXPECT_TRUE(has(text, "test_profile")) << text;
  EXPECT_FALSE(has(text, "mobility_framework")) << text;
  view::server::Run view(folder);
  EXPECT_TRUE(has(view.answer("world").value(), R"("profile":"test_profile")"));
}

TEST_F(Extension, AForeignProtocolNamesItsPacketsAndTellsItsWeights) {
  scenario.simulation.routing.algorithm = kTestProtocol;
  const auto folder = run();
  EXPECT_EQ(setting(folder, "routing.algorithm"), "test_protocol");
  EXPECT_EQ(asked(folder, "SELECT COUNT(*) FROM deliveries"), "1");
  EXPECT_EQ(asked(folder,
                  "SELECT group_concat(packet || ' ' || IFNULL(sender || '/' || message, '-')) FROM"
                  " (SELECT * FROM frames WHERE packet IS NOT NULL ORDER BY at_ns)"),
            "test call -,test message 1/1");
  EXPECT_EQ(asked(folder, "SELECT group_concat(destination || ' ' || weight) FROM routes"),
            "2 7.0");
  view::server::Run view(folder);
  const std::string frames = view.answer("frames/13/0").value();
  EXPECT_TRUE(has(frames, R"("test call")") && has(frames, R"("test message")")) << frames;
  const std::string routes = view.answer("routes/1").value();
  EXPECT_TRUE(has(routes, R"("weight":[7)")) << routes;
  EXPECT_TRUE(has(routes, R"("probability":[1)")) << routes;
}

// Agents of one network may speak several protocols: each frame is named by who sent it.
TEST_F(Extension, EachAgentsFramesAreNamedByItsOwnProtocol) {
  scenario.simulation.routing.algorithm = hal::node::routing::Algorithm::kAodv;
  const auto aodv = run("aodv");
  EXPECT_EQ(asked(aodv, "SELECT COUNT(*) > 0 FROM frames WHERE packet = 'RREQ'"), "1");
  EXPECT_EQ(asked(aodv, "SELECT group_concat(DISTINCT weight) FROM routes WHERE weight NOT NULL"),
            "1.0");
  scenario.simulation.agents.front().routing = kTestProtocol;
  const auto mixed = run("mixed");
  EXPECT_EQ(asked(mixed, "SELECT group_concat(DISTINCT packet) FROM frames WHERE transmitter = 1"),
            "test call,test message");
  EXPECT_EQ(setting(mixed, "agents.m.routing"), "test_protocol");
}

// What a file cannot say is refused by name when it is read back, not taken for something else.
TEST_F(Extension, AFileCannotNameWhatIsForeign) {
  waves().propagation.chain = {kTestLaw};
  const auto file = run() / "scenario.resolved.yaml";
  try {
    (void)sim::scenario::load_scenario(file);
    FAIL() << "the law was taken for another one";
  } catch (const std::exception& refusal) {
    EXPECT_TRUE(has(refusal.what(), "'test_law'")) << refusal.what();
  }
}

}  // namespace
}  // namespace tests
