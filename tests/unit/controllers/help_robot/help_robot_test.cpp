#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/controllers/help_robot/robot_bench.h"

namespace {

using namespace std::chrono_literals;
using controllers::HelpWord;
using hal::node::exchange::Invalidate;
using hal::node::exchange::Send;
using tests::Actions;
using Said = tests::RobotBench::Said;
using States = std::vector<std::string>;

constexpr int kMote = 17;
constexpr int kHop = 6;

template <class What>
int count(const Actions& actions) {
  return static_cast<int>(tests::all<What>(actions).size());
}

/// The velocity the robot was left with.
hal::Twist2 last_drive(const Actions& actions) {
  hal::Twist2 twist{.vx = -99};
  for (const auto& drive : tests::all<hal::node::exchange::DriveBody>(actions)) twist = drive.twist;
  return twist;
}

/// Mote 17 has called; the hop 6 is 100 m ahead, 3 hops from the mote, which is 300 m ahead.
class HelpRobot : public testing::Test {
 protected:
  void SetUp() override {
    EXPECT_EQ(tests::states(bench.agent->start()), States{"IDLE"});
    bench.positions = {{kHop, {100, 0}}, {kMote, {300, 0}}};
    bench.hear(kMote, HelpWord::kHelp);
    asked_ = bench.control();
  }

  /// The mote grants; there is a route via `next_hop`.
  Actions grant(int next_hop, int hops) {
    bench.learn(kMote, next_hop, hops);
    return bench.hear(kMote, HelpWord::kGrant);
  }

  tests::RobotBench bench;
  Actions asked_;  ///< What the first control cycle after the call did.
};

TEST_F(HelpRobot, AsksTheMoteThatCalled) {
  EXPECT_EQ(tests::states(asked_), (States{"SELECT_DESTINATION", "REQUEST_ASSIGNMENT"}));
  EXPECT_EQ(bench.said(asked_), (Said{{kMote, HelpWord::kAsk}}));
  for (const Send& message : tests::all<Send>(asked_)) {
    EXPECT_EQ(controllers::decode(message.payload).value().max_hop, 300s);
  }
}

TEST_F(HelpRobot, AsksThreeMoreTimesEveryThirtySecondsThenGivesUp) {
  for (const auto at : {30100ms, 60100ms, 90100ms}) {
    EXPECT_TRUE(bench.run_until(at - 100ms).empty());
    const Actions repeat = bench.run_until(at);
    EXPECT_EQ(bench.said(repeat), (Said{{kMote, HelpWord::kAsk}}));
    EXPECT_EQ(count<Invalidate>(repeat), 1) << "the old route brought no answer";
  }
  EXPECT_TRUE(bench.run_until(120s).empty());
  const Actions end = bench.run_until(120100ms);
  EXPECT_EQ(bench.said(end), (Said{{kMote, HelpWord::kGiveUp}}));
  EXPECT_EQ(tests::states(end), (States{"GIVE_UP", "IDLE"}));
  EXPECT_TRUE(bench.run_until(200s).empty()) << "the mote is off the list";
}

TEST_F(HelpRobot, GoesBackToIdleWhenRefusedAndTakesTheNextCall) {
  bench.hear(9, HelpWord::kHelp);
  EXPECT_EQ(tests::states(bench.hear(kMote, HelpWord::kRefuse)), States{"IDLE"});
  EXPECT_EQ(bench.said(bench.control()), (Said{{9, HelpWord::kAsk}}));
}

TEST_F(HelpRobot, IgnoresAnswersOfOthers) {
  EXPECT_TRUE(bench.hear(9, HelpWord::kGrant).empty());
  EXPECT_TRUE(bench.hear(9, HelpWord::kRefuse).empty());
}

TEST_F(HelpRobot, GoesToTheHopOnItsRouteWhenGranted) {
  EXPECT_EQ(tests::states(grant(kHop, 3)), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
  const hal::Twist2 drive = last_drive(bench.control());
  EXPECT_NEAR(drive.vx, 0.94, 1e-12);
  EXPECT_NEAR(drive.vy, 0, 1e-12);
  EXPECT_NEAR(drive.omega, 0, 1e-12) << "a sensor looks ahead already";
}

TEST_F(HelpRobot, AsksForARouteWhenThereIsNone) {
  const Actions none = bench.hear(kMote, HelpWord::kGrant);
  EXPECT_EQ(tests::states(none), (States{"FIND_NEXT_HOP", "REQUEST_NEXT_HOP"}));
  EXPECT_EQ(bench.said(none), (Said{{kMote, HelpWord::kAsk}}));
  EXPECT_TRUE(bench.hear(kMote, HelpWord::kGrant).empty()) << "still none";
  bench.learn(kMote, kHop, 3);
  EXPECT_EQ(tests::states(bench.control()), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
}

TEST_F(HelpRobot, GivesUpWhenNoRouteAppears) {
  bench.hear(kMote, HelpWord::kGrant);
  const Actions actions = bench.run_until(130s);
  EXPECT_EQ(bench.said(actions), (Said{{kMote, HelpWord::kAsk},
                                       {kMote, HelpWord::kAsk},
                                       {kMote, HelpWord::kAsk},
                                       {kMote, HelpWord::kGiveUp}}));
}

TEST_F(HelpRobot, HasAllItsRepeatsAgainForTheNextQuestion) {
  bench.run_until(61s);  // two repeats used up
  bench.hear(kMote, HelpWord::kGrant);
  EXPECT_EQ(bench.said(bench.run_until(61s + 120s)).size(), 4U) << "three times, then it gives up";
}

TEST_F(HelpRobot, KeepsInTouchEveryFifteenSecondsAndRenewsTheRouteOnTheWay) {
  grant(kHop, 3);
  const auto granted = bench.agent->now.time_since_epoch();
  EXPECT_EQ(count<Send>(bench.run_until(granted + 14900ms)), 0);
  for (int i = 1; i <= 3; ++i) {
    const Actions actions = bench.run_until(granted + i * 15s);
    EXPECT_EQ(bench.said(actions), (Said{{kMote, HelpWord::kAsk}}));
    EXPECT_EQ(count<Invalidate>(actions), 1);
  }
}

TEST_F(HelpRobot, KeepsInTouchWithoutRenewingOnTheLastHop) {
  EXPECT_EQ(tests::states(grant(kMote, 1)), (States{"FIND_NEXT_HOP", "GO_TO_DESTINATION"}));
  const Actions actions = bench.run_until(bench.agent->now.time_since_epoch() + 31s);
  EXPECT_EQ(bench.said(actions).size(), 2U);
  EXPECT_EQ(count<Invalidate>(actions), 0);
}

TEST_F(HelpRobot, AsksOnceForTheNextHopTenMetresBeforeThisOne) {
  grant(kHop, 3);
  bench.positions[kHop] = {10.1, 0};
  EXPECT_EQ(count<Send>(bench.control()), 0);
  bench.positions[kHop] = {0, 9.9};
  const Actions near = bench.control();
  EXPECT_EQ(bench.said(near), (Said{{kMote, HelpWord::kAsk}}));
  EXPECT_EQ(count<Invalidate>(near), 1);
  EXPECT_EQ(count<Send>(bench.control()), 0) << "only once";
}

TEST_F(HelpRobot, LooksForTheNextHopFourMetresBeforeThisOneAndDoesNotTurnBack) {
  grant(kHop, 3);
  bench.positions[kHop] = {4.1, 0};
  EXPECT_TRUE(tests::states(bench.control()).empty());
  bench.learn(kMote, kHop, 3);  // the way back: closer, but just left
  bench.learn(kMote, 12, 9);
  bench.positions[12] = {0, 100};
  bench.positions[kHop] = {3.9, 0};
  EXPECT_EQ(tests::states(bench.control()), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
  EXPECT_GT(last_drive(bench.control()).vy, 0.85) << "to 12, and turning a sensor that way";
}

TEST_F(HelpRobot, StopsAndAsksWhenTheOnlyRouteLeadsBackToWhereItStands) {
  grant(kHop, 3);
  bench.run_until(2s);
  bench.positions[kHop] = {3.9, 0};
  const Actions asked = bench.control();
  EXPECT_EQ(tests::states(asked), (States{"FIND_NEXT_HOP", "REQUEST_NEXT_HOP"}));
  EXPECT_EQ(bench.said(asked), (Said{{kMote, HelpWord::kAsk}}));
  EXPECT_EQ(count<Invalidate>(asked), 1) << "so that the network searches anew";
  EXPECT_EQ(last_drive(asked), hal::Twist2{});

  bench.learn(kMote, kHop, 3);  // the same route again is no use
  EXPECT_TRUE(tests::states(bench.hear(kMote, HelpWord::kGrant)).empty());
  bench.learn(kMote, 7, 4);
  EXPECT_EQ(tests::states(bench.control()), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
}

TEST_F(HelpRobot, AsksAgainTenMetresBeforeTheNextHop) {
  grant(kHop, 3);
  bench.positions = {{kHop, {9.9, 0}}, {12, {100, 0}}};
  EXPECT_EQ(bench.said(bench.control()).size(), 1U);
  bench.learn(kMote, 12, 2);
  bench.positions[kHop] = {3.9, 0};
  EXPECT_EQ(tests::states(bench.control()), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
  bench.positions[12] = {9.9, 0};
  EXPECT_EQ(bench.said(bench.control()), (Said{{kMote, HelpWord::kAsk}}));
}

TEST_F(HelpRobot, LeavesAWallForTheNextHop) {
  grant(kHop, 3);
  bench.ranges[0] = 0.3;
  EXPECT_LT(last_drive(bench.control()).vx, 0.1);
  bench.ranges[0] = std::numeric_limits<double>::quiet_NaN();
  bench.learn(kMote, kHop, 3, true);
  bench.learn(kMote, 12, 2);
  bench.positions = {{kHop, {3.9, 0}}, {12, {100, 0}}};
  EXPECT_EQ(tests::states(bench.control()), (States{"FIND_NEXT_HOP", "GO_TO_NEXT_HOP"}));
  EXPECT_NEAR(last_drive(bench.control()).vx, 0.94, 1e-12);
}

TEST_F(HelpRobot, MayTurnBackForAnotherMote) {
  grant(kHop, 3);
  bench.positions[kHop] = {3.9, 0};
  bench.control();  // leaves the hop
  bench.hear(kMote, HelpWord::kRefuse);
  bench.hear(9, HelpWord::kHelp);
  bench.control();
  bench.learn(9, kHop, 3);
  bench.learn(9, kMote, 2000);  // 1 / h^2: drawn once in 450000 if there is a choice
  bench.hear(9, HelpWord::kGrant);
  bench.positions = {{kHop, {0, 100}}, {kMote, {0, -100}}};
  EXPECT_GT(last_drive(bench.control()).vy, 0) << "to the hop it left for the other mote";
}

TEST_F(HelpRobot, ArrivesTenMetresBeforeTheMote) {
  grant(kMote, 1);
  bench.positions[kMote] = {10.1, 0};
  EXPECT_TRUE(tests::states(bench.control()).empty());
  bench.positions[kMote] = {9.9, 0};
  const Actions actions = bench.control();
  EXPECT_EQ(bench.said(actions), (Said{{kMote, HelpWord::kArrived}}));
  EXPECT_EQ(tests::states(actions), (States{"ARRIVED", "IDLE"}));
  EXPECT_EQ(last_drive(actions), hal::Twist2{}) << "it stands";
}

TEST_F(HelpRobot, GivesUpAHopAfterThreeHundredSeconds) {
  grant(kHop, 3);
  const auto granted = bench.agent->now.time_since_epoch();
  EXPECT_TRUE(tests::states(bench.run_until(granted + 300s - 100ms)).empty());
  const Actions actions = bench.run_until(granted + 300s);
  EXPECT_EQ(tests::states(actions), (States{"GIVE_UP", "IDLE"}));
  EXPECT_EQ(bench.said(actions), (Said{{kMote, HelpWord::kGiveUp}}));
  EXPECT_EQ(last_drive(actions), hal::Twist2{});
}

TEST_F(HelpRobot, StopsWhenTheMoteTakesTheTaskBack) {
  grant(kHop, 3);
  bench.control();
  const Actions actions = bench.hear(kMote, HelpWord::kRefuse);
  EXPECT_EQ(tests::states(actions), States{"IDLE"});
  EXPECT_EQ(last_drive(actions), hal::Twist2{});
}

TEST_F(HelpRobot, StandsWhileTheHopIsNotLocalised) {
  grant(kHop, 3);
  EXPECT_GT(last_drive(bench.control()).vx, 0.9);
  bench.positions.clear();
  EXPECT_EQ(last_drive(bench.control()), hal::Twist2{});
}

using Ways = std::vector<std::pair<int, hal::PathStatistics>>;

/// How often each hop is drawn from the routes in so many runs that differ in their seed.
std::map<int, int> draws_of(const Ways& routes, int runs, const std::string& metric) {
  std::map<int, int> drawn;
  for (int seed = 0; seed < runs; ++seed) {
    auto session = tests::robot_session();
    session.seed = static_cast<std::uint64_t>(seed);
    session.parameters = {{.name = "metric", .value = metric, .place = "here"}};
    tests::RobotBench bench;
    bench.agent = std::make_unique<tests::OneAgent>(*baraka_controller(), session);
    bench.hear(kMote, HelpWord::kHelp);
    bench.control();
    double bearing = 0;  // 0.5 rad apart, so that the drive tells the hops apart
    for (const auto& [hop, path] : routes) {
      bench.learn(kMote, hop, path);
      bench.positions[hop] = {100 * std::cos(bearing), 100 * std::sin(bearing)};
      bearing += 0.5;
    }
    bench.hear(kMote, HelpWord::kGrant);
    const hal::Twist2 drive = last_drive(bench.control());
    ++drawn[static_cast<int>(std::lround(std::atan2(drive.vy, drive.vx) / 0.5))];
  }
  return drawn;
}

/// The same from routes (hop, number of hops).
std::map<int, int> draws(const std::vector<std::pair<int, int>>& routes, int runs) {
  Ways ways;
  for (const auto& [hop, hops] : routes) {
    ways.emplace_back(hop, hal::PathStatistics{.hops = static_cast<std::uint16_t>(hops)});
  }
  return draws_of(ways, runs, "hops");
}

// P ~ (1/h)^2: 1/4, 1/9 and 1/36 give 9 : 4 : 1. Of 1400 draws 900, 400, 100 are expected; four
// standard deviations of the binomial are 72, 68 and 39.
TEST(HelpRobotsChoice, FollowsTheInverseSquareOfTheHops) {
  auto drawn = draws({{3, 2}, {4, 3}, {5, 6}}, 1400);
  EXPECT_NEAR(drawn[0], 900, 72);
  EXPECT_NEAR(drawn[1], 400, 68);
  EXPECT_NEAR(drawn[2], 100, 39);
}

// Four ways, each far better than the others in one statistic.
TEST(HelpRobotsChoice, FollowsTheStatisticThatItsParameterNames) {
  const Ways ways{{3, {.hops = 1, .delay = 1s, .min_snr_db = -20, .energy = 1}},
                  {4, {.hops = 50, .delay = 1ms, .min_snr_db = -20, .energy = 1}},
                  {5, {.hops = 50, .delay = 1s, .min_snr_db = 60, .energy = 1}},
                  {6, {.hops = 50, .delay = 1s, .min_snr_db = -20, .energy = 1e-3}}};
  const std::vector<std::string> metrics{"hops", "delay", "min_snr", "energy"};
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    EXPECT_GE(draws_of(ways, 50, metrics[i])[static_cast<int>(i)], 48) << metrics[i];
  }
}

// The mote itself has weight (10^6)^2 against 1/4.
TEST(HelpRobotsChoice, IsTheMoteItselfWhereverItIsANeighbour) {
  auto drawn = draws({{3, 2}, {kMote, 1}}, 200);
  EXPECT_EQ(drawn[1], 200);
}

}  // namespace
