#include "results/record/scalars.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>

#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

/// Two agents, one of them a robot; three messages to one agent, two of which arrived; a flood.
constexpr const char* kRun =
    "INSERT INTO run VALUES ('simulated_s', 10.0), ('ended_ns', 10000000000), ('events', 42),"
    " ('refused_actions', 1), ('wall_s', 3.0);"
    "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0), (2, 'r0', 'robot', 'p', 1, 0, 0);"
    "INSERT INTO countable VALUES ('messages.ends', '', 'delivered'),"
    " ('messages.ends', '', 'no route'), ('messages.ends', '', 'retry limit'),"
    " ('frames', '', 'ack'), ('requests', '', 'retry limit'), ('receptions', '', 'collision'),"
    " ('routing.events', '', 'hello sent'), ('states', 'p', 'GOES HOME'), ('states', 'p', 'STUCK'),"
    " ('states', 'q', 'OF OTHERS'), ('controllers', 'p', 'need'), ('controllers', 'p', 'way');"
    "INSERT INTO messages VALUES"
    " (1, 1, 2, 'Help call', 100, 0, NULL, NULL, 'delivered', 0),"
    " (1, 2, 2, 'Help call', 50, 0, NULL, NULL, 'delivered', 0),"
    " (1, 3, 2, 'audio', 50, 0, NULL, NULL, 'no route', 0),"
    " (1, 4, 65535, 'audio', 50, 0, NULL, NULL, 'delivered', 0);"
    "INSERT INTO deliveries VALUES (1, 1, 2, 5, 1000000000, 1), (1, 2, 2, 6, 3000000000, 3),"
    " (1, 4, 2, 7, 9000000000, 1);"
    "INSERT INTO discoveries VALUES (1, 'a', 2, 9, 500000000, 1), (1, 'a', 2, 9, 900000000, 0);"
    "INSERT INTO bodies VALUES (1, 0, NULL, 0, 0, 0, 0, 0, 0), (2, 7.5, 0.25, 0, 1, 0, 0, 3, 4);"
    "INSERT INTO agent_use VALUES (1, 100, 200, 700, 0, 5, NULL, NULL),"
    " (2, 0, 500, 500, 0, 2, 12.5, 13.5);"
    "INSERT INTO states VALUES (2, 1000000000, 'GOES HOME'), (2, 4000000000, 'RESTS'),"
    " (2, 9000000000, 'GOES HOME');"
    "INSERT INTO recorded VALUES (2, 1000000000, 'need', 0.5), (2, 2000000000, 'need', 0.75),"
    " (2, 2000000000, 'distance', 3);";

class Scalars : public testing::Test {
 protected:
  explicit Scalars(const std::string& rows = kRun)
      : folder(testing::UnitTest::GetInstance()->current_test_info()->name()) {
    make_result(folder.path(), rows);
    RunReader reader(folder.path());
    all = scalars_of(reader);
    series = series_of(reader);
    bins = bins_of(reader);
  }

  std::optional<double> value(const std::string& name, const std::string& agent = "") const {
    const auto found = std::ranges::find_if(
        all, [&](const Scalar& one) { return one.name == name && one.agent == agent; });
    if (found == all.end()) return std::nullopt;
    return found->value;
  }

  Folder folder;
  std::vector<Scalar> all;
  std::vector<Series> series;
  std::vector<Bins> bins;
};

/// The same, and two agents' observables; one of them kept in two ways, and one of a controller.
constexpr const char* kObserved =
    "INSERT INTO observables VALUES (1, 'agents.x', 1, 'm', 'samples', 500000000, 0),"
    " (2, 'agents.x', 2, 'm', 'samples', 500000000, 0),"
    " (3, 'agents.x', 2, 'm', 'quantiles', 100000000, 0),"
    " (4, 'controllers.need', 2, 'W', 'histogram', NULL, 0);"
    "INSERT INTO observable_samples VALUES (1, 0, 1), (2, 0, 2), (1, 500000000, 3);"
    "INSERT INTO observable_sums VALUES (1, 2, 2, 1.5, 1, 3, 4, 3, 2.5),"
    " (2, 1, 2, NULL, 2, 2, 2, 2, 2), (3, 9, 5, 1, 5, 5, 45, 5, 5), (4, 2, 0.7, 0, 0, 1, 1, 1, 1);"
    "INSERT INTO observable_quantiles VALUES (3, 0.05, 4.5, 0);"
    "INSERT INTO observable_bins VALUES (4, NULL, 0, 1), (4, 0, 2.5, 7);";

struct ScalarsOfObservables : Scalars {
  ScalarsOfObservables() : Scalars(std::string(kRun) + kObserved) {}
};

/// Words that are equal as parts of names, and what two requests both keep in the same way.
constexpr const char* kTwins =
    "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0);"
    "INSERT INTO run VALUES ('ended_ns', 10000000000);"
    "INSERT INTO messages VALUES (1, 1, 2, 'cam_1', 1, 0, NULL, NULL, 'delivered', 0),"
    " (1, 2, 2, 'cam_1', 1, 0, NULL, NULL, 'delivered', 0),"
    " (1, 3, 2, 'cam-1', 1, 0, NULL, NULL, 'no route', 0);"
    "INSERT INTO deliveries VALUES (1, 1, 2, 5, 1000000000, 1);"
    "INSERT INTO states VALUES (1, 0, 'AT_1'), (1, 4000000000, 'AT 1');"
    "INSERT INTO recorded VALUES (1, 0, 'x y', 1), (1, 1, 'x-y', 2), (1, 2, 'x_y', 3);"
    "INSERT INTO observables VALUES (1, 'controllers.x-y', 1, '', 'quantiles', NULL, 0),"
    " (2, 'controllers.x-y', 1, '', 'quantiles', NULL, 0),"
    " (3, 'a.b', 1, '', 'histogram', NULL, 0), (4, 'a.b', 1, '', 'histogram', NULL, 0),"
    " (5, 'a.c', 1, '', 'samples', NULL, 0), (6, 'a.c', 1, '', 'samples', NULL, 0);"
    "INSERT INTO observable_sums VALUES (1, 9, 2, 2, 0, 2, 2, 2, 2), (2, 9, 2, 2, 0, 2, 2, 2, 2);"
    "INSERT INTO observable_quantiles VALUES (1, 0.5, 2, 0), (2, 0.5, 3, 0);"
    "INSERT INTO observable_bins VALUES (3, 0, 1, 7), (4, 0, 1, 8);"
    "INSERT INTO observable_samples VALUES (5, 0, 1), (6, 0, 2);";

struct ScalarsOfTwins : Scalars {
  ScalarsOfTwins() : Scalars(kTwins) {}
};

/// An observable of something that never happened.
struct ScalarsOfNothingObserved : Scalars {
  ScalarsOfNothingObserved()
      : Scalars(
            "INSERT INTO agents VALUES (1, 'm0', 'mote', 'p', 0, 0, 0);"
            "INSERT INTO observables VALUES (1, 'messages.delay', 1, 's', 'counter', NULL, 0);"
            "INSERT INTO observable_sums VALUES (1, 0, NULL, NULL, NULL, NULL, 0, NULL, NULL);") {}
};

struct ScalarsOfNothing : Scalars {
  ScalarsOfNothing() : Scalars("SELECT 1;") {}
};

TEST_F(Scalars, CountMessagesToOneAgent) {
  EXPECT_EQ(value("messages.sent"), 3);
  EXPECT_EQ(value("messages.delivered"), 2);
  EXPECT_DOUBLE_EQ(*value("messages.delivery_ratio"), 2.0 / 3);
  EXPECT_EQ(value("messages.ends.no_route"), 1);
  EXPECT_EQ(value("topics.help_call.sent"), 2);
  EXPECT_EQ(value("topics.audio.delivered"), 0);
  EXPECT_DOUBLE_EQ(*value("messages.goodput"), 8 * 150 / 10.0);
  EXPECT_EQ(value("messages.transmissions.mean"), 2);
}

TEST_F(Scalars, CountWhatCouldHaveBeenAndWasNotAsZero) {
  EXPECT_EQ(value("messages.ends.delivered"), 2);
  EXPECT_EQ(value("messages.ends.retry_limit"), 0);
  EXPECT_EQ(value("messages.ends.expired"), std::nullopt) << "not with these messages";
  EXPECT_EQ(value("requests.retry_limit"), 0);
  EXPECT_EQ(value("receptions.collision"), 0);
  EXPECT_EQ(value("frames.ack"), 0);
  EXPECT_EQ(value("frames.sent"), 0);
  EXPECT_EQ(value("routing.events.hello_sent"), 0);
}

TEST_F(Scalars, CountOfEachAgentWhatItsControllerDeclaresAsZero) {
  EXPECT_EQ(value("states.stuck.entries", "r0"), 0);
  EXPECT_EQ(value("states.stuck.time", "m0"), 0);
  EXPECT_EQ(value("states.stuck.first", "r0"), std::nullopt) << "it never was";
  EXPECT_EQ(value("states.goes_home.entries", "m0"), 0);
  EXPECT_EQ(value("states.rests.entries", "m0"), std::nullopt) << "r0 names it, nobody declares it";
  EXPECT_EQ(value("states.of_others.entries", "r0"), std::nullopt) << "of another program";
  EXPECT_EQ(value("controllers.way.count", "r0"), 0);
  EXPECT_EQ(value("controllers.way.mean", "r0"), std::nullopt);
  EXPECT_EQ(value("controllers.need.count", "m0"), 0);
  EXPECT_EQ(value("controllers.need.count", "r0"), 2);
}

TEST_F(Scalars, CountBroadcasts) {
  EXPECT_EQ(value("broadcasts.sent"), 1);
  EXPECT_EQ(value("broadcasts.deliveries"), 1);
  EXPECT_EQ(value("broadcasts.addressees"), 1);
  EXPECT_EQ(value("broadcasts.reach"), 1);
}

// R: quantile(c(1, 3), c(.5, .95, .99), type = 7) is 2.00 2.90 2.98.
TEST_F(Scalars, GiveQuantilesOfDelays) {
  EXPECT_DOUBLE_EQ(*value("messages.delay.mean"), 2);
  EXPECT_DOUBLE_EQ(*value("messages.delay.median"), 2);
  EXPECT_DOUBLE_EQ(*value("messages.delay.p95"), 2.9);
  EXPECT_DOUBLE_EQ(*value("messages.delay.p99"), 2.98);
  EXPECT_DOUBLE_EQ(*value("messages.delay.max"), 3);
  EXPECT_DOUBLE_EQ(*value("discoveries.time.median"), 0.5);
  EXPECT_EQ(value("discoveries.failed"), 1);
}

TEST_F(Scalars, AreOfRobotsWhereAgentsAreNamed) {
  EXPECT_EQ(value("agents.path", "r0"), 7.5);
  EXPECT_EQ(value("agents.path", "m0"), std::nullopt);
  EXPECT_EQ(value("paths.sum"), 7.5);
  EXPECT_EQ(value("agents.wall_steps", "r0"), 3);
}

TEST_F(Scalars, SayWhatAgentsUsed) {
  EXPECT_EQ(value("use.transmitting", "m0"), 0.1);
  EXPECT_EQ(value("use.receiving", "r0"), 0.5);
  EXPECT_EQ(value("frames.retries"), 7);
  EXPECT_EQ(value("use.energy", "m0"), std::nullopt);
  EXPECT_EQ(value("energy.sum"), 12.5);
  EXPECT_EQ(value("load.sum"), 13.5);
}

TEST_F(Scalars, SayHowLongAStateLasted) {
  EXPECT_DOUBLE_EQ(*value("states.goes_home.time", "r0"), 3 + 1);
  EXPECT_DOUBLE_EQ(*value("states.rests.time", "r0"), 5);
  EXPECT_EQ(value("states.goes_home.entries", "r0"), 2);
  EXPECT_DOUBLE_EQ(*value("states.goes_home.first", "r0"), 1);
}

TEST_F(Scalars, SumUpWhatControllersRecorded) {
  EXPECT_EQ(value("controllers.need.mean", "r0"), 0.625);
  EXPECT_EQ(value("controllers.need.last", "r0"), 0.75);
  EXPECT_EQ(value("controllers.distance.count", "r0"), 1);
  ASSERT_EQ(series.size(), 2u);
  EXPECT_EQ(series[1].name, "controllers.need");
  EXPECT_EQ(series[1].agent, "r0");
  EXPECT_EQ(series[1].points, (std::vector<std::pair<double, double>>{{1, 0.5}, {2, 0.75}}));
}

TEST_F(Scalars, NameEachNumberOnce) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Scalar& one : all) EXPECT_TRUE(names.emplace(one.name, one.agent).second) << one.name;
}

TEST_F(ScalarsOfObservables, SumThemUpByAgent) {
  EXPECT_EQ(value("agents.x.mean", "m0"), 2);
  EXPECT_EQ(value("agents.x.sd", "m0"), 1.5);
  EXPECT_EQ(value("agents.x.sd", "r0"), std::nullopt);
  EXPECT_EQ(value("agents.x.mean_over_time", "m0"), 2.5);
  EXPECT_EQ(value("agents.x.count", "r0"), 1) << "the first way counts";
  EXPECT_EQ(value("agents.x.p05", "r0"), 4.5);
}

TEST_F(ScalarsOfObservables, CountWhatAControllerRecordsAsObserved) {
  EXPECT_EQ(value("controllers.need.mean", "r0"), 0.7);
  EXPECT_EQ(std::ranges::count(all, "controllers.need.mean", &Scalar::name), 1);
  const auto need = std::ranges::find(all, "controllers.need.mean", &Scalar::name);
  EXPECT_EQ(need->unit, "W");
}

TEST_F(ScalarsOfObservables, HaveSeriesAndBins) {
  ASSERT_EQ(series.size(), 4u);
  EXPECT_EQ(series[0].name + " " + series[0].agent + " " + series[0].unit, "agents.x m0 m");
  EXPECT_EQ(series[0].points, (std::vector<std::pair<double, double>>{{0, 1}, {0.5, 3}}));
  ASSERT_EQ(bins.size(), 1u);
  EXPECT_EQ(bins[0].name, "controllers.need");
  ASSERT_EQ(bins[0].bins.size(), 2u);
  EXPECT_LT(bins[0].bins[0].lower, -1e300);
  EXPECT_EQ(bins[0].bins[1].count, 7u);
}

TEST_F(ScalarsOfTwins, HaveNamesOfTheirOwn) {
  std::set<std::pair<std::string, std::string>> names;
  for (const Scalar& one : all) EXPECT_TRUE(names.emplace(one.name, one.agent).second) << one.name;
  EXPECT_EQ(value("topics.cam_1.sent"), 1) << "cam-1";
  EXPECT_EQ(value("topics.cam_1_2.sent"), 2) << "cam_1";
  EXPECT_EQ(value("topics.cam_1.delay.mean"), std::nullopt);
  EXPECT_EQ(value("topics.cam_1_2.delay.mean"), 1) << "the same one in each kind of number";
  EXPECT_EQ(value("states.at_1.first", "m0"), 4);
  EXPECT_EQ(value("states.at_1_2.first", "m0"), 0);
}

TEST_F(ScalarsOfTwins, AreTheFirstOfWhatIsKeptTwice) {
  EXPECT_EQ(value("controllers.x_y_2.count", "m0"), 9);
  EXPECT_EQ(value("controllers.x_y_2.p50", "m0"), 2);
  ASSERT_EQ(bins.size(), 1u);
  ASSERT_EQ(bins[0].bins.size(), 1u);
  EXPECT_EQ(bins[0].bins[0].count, 7u);
}

TEST_F(ScalarsOfTwins, HaveSeriesOfTheirNames) {
  std::vector<std::string> names;
  for (const Series& one : series) names.push_back(one.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a.c", "controllers.x_y", "controllers.x_y_2",
                                             "controllers.x_y_3"}));
  EXPECT_EQ(series[0].points, (std::vector<std::pair<double, double>>{{0, 1}}));
  EXPECT_EQ(value("controllers.x_y_3.mean", "m0"), series[3].points[0].second);
}

TEST_F(ScalarsOfNothingObserved, CountNone) {
  EXPECT_EQ(value("messages.delay.count", "m0"), 0);
  EXPECT_EQ(value("messages.delay.mean", "m0"), std::nullopt);
}

TEST_F(ScalarsOfNothing, LeaveOutWhatThereIsNot) {
  EXPECT_EQ(value("messages.sent"), std::nullopt) << "messages were not counted, nor frames";
  EXPECT_EQ(value("broadcasts.sent"), std::nullopt);
  EXPECT_EQ(value("frames.sent"), std::nullopt);
  EXPECT_EQ(value("receptions.collision"), std::nullopt);
  EXPECT_EQ(value("messages.delivery_ratio"), std::nullopt);
  EXPECT_EQ(value("messages.delay.median"), std::nullopt);
  EXPECT_EQ(value("broadcasts.reach"), std::nullopt);
  EXPECT_TRUE(series.empty());
}

TEST_F(Scalars, OfARunWithoutNetworksAreNotOfTopics) {
  for (const Scalar& one : all)
    EXPECT_FALSE(one.name.starts_with("dds.") || one.name.starts_with("air.")) << one.name;
}

}  // namespace
}  // namespace results::record::test
