#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "sim/physics/awake_list.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/robertino.h"

namespace sim::physics::test {
namespace {

using hal::node::devices::MoteDescription;

constexpr AgentId kRobot{1};
constexpr std::uint16_t kFirstMote = 2;

std::vector<AwakeList::Member> members_of(AwakeList& list) {
  const auto members = list.members();
  return {members.begin(), members.end()};
}

TEST(AwakeList, IsAscendingHoweverItWasFilled) {
  AwakeList list;
  for (const std::size_t object : {5U, 2U, 5U, 9U}) list.add(object);
  EXPECT_EQ(members_of(list), (std::vector<AwakeList::Member>{2, 5, 9}));
  for (const std::size_t object : {0U, 7U, 2U, 12U}) list.add(object);
  EXPECT_EQ(members_of(list), (std::vector<AwakeList::Member>{0, 2, 5, 7, 9, 12}));
}

TEST(AwakeList, WhoWasLetGoOfCanComeBack) {
  AwakeList list;
  for (const std::size_t object : {1U, 2U, 3U}) list.add(object);
  std::vector<AwakeList::Member> asked;
  list.keep_if([&](AwakeList::Member object) {
    asked.push_back(object);
    return object != 2;
  });
  EXPECT_EQ(asked, (std::vector<AwakeList::Member>{1, 2, 3}));
  EXPECT_EQ(members_of(list), (std::vector<AwakeList::Member>{1, 3}));
  list.add(2);
  EXPECT_EQ(members_of(list), (std::vector<AwakeList::Member>{1, 2, 3}));
}

/// A robot and a field of motes: few, or so many that sleepers far from it are left out of the
/// search for contacts.
class AwakeWorld : public testing::TestWithParam<int> {
 protected:
  AwakeWorld() {
    world.add_robot(kRobot, robertino(hal::node::devices::WheelLevel::kContact), {-1, 0, 0});
    for (int i = 0; i < GetParam(); ++i) {
      const auto mote = static_cast<std::uint16_t>(kFirstMote + i);
      world.add_mote(AgentId{mote}, MoteDescription{}, {0.5 * (i / 10), 0.5 * (i % 10), 0});
    }
  }

  /// One step; checks what the world says of it against where everybody was before it.
  void step() {
    std::vector<hal::Vec3> before;
    for (std::uint16_t i = 1; i <= last(); ++i) before.push_back(world.position(AgentId{i}));
    world.step();
    const auto moved = world.moved();
    EXPECT_TRUE(std::is_sorted(moved.begin(), moved.end()));
    for (std::uint16_t i = 1; i <= last(); ++i) {
      const AgentId agent{i};
      const bool is_listed = std::ranges::binary_search(moved, agent);
      EXPECT_EQ(is_listed, !world.asleep(agent)) << i;
      EXPECT_EQ(is_listed, world.moved_at(agent) == world.steps()) << i;
      EXPECT_TRUE(is_listed || world.position(agent) == before[i - 1u]) << i;
      // Also those that nobody has told of a push.
      EXPECT_EQ(world.position(agent), world.pose(agent).position) << i;
    }
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) step();
  }
  std::uint16_t last() const { return static_cast<std::uint16_t>(GetParam() + kFirstMote - 1); }

  World world{WorldConfig{}};
};

TEST_P(AwakeWorld, NobodyMovesOnceAllHaveComeToRest) {
  run(80);
  EXPECT_TRUE(world.moved().empty());
  const std::uint64_t rested = world.moved_at(AgentId{kFirstMote});
  EXPECT_GT(rested, 0U);
  run(10);
  EXPECT_EQ(world.moved_at(AgentId{kFirstMote}), rested);
}

TEST_P(AwakeWorld, ACommandWakesARobotAndItsTouchASleepingMote) {
  run(80);
  ASSERT_TRUE(world.set_body_velocity(kRobot, {0.5, 0, 0}).has_value());
  step();
  EXPECT_EQ(world.moved().size(), 1U);
  EXPECT_EQ(world.moved().front(), kRobot);
  run(250);  // over 2 m: into the first row, whose first mote it pushes along
  EXPECT_GT(world.position(AgentId{kFirstMote}).x, 0.2);
  EXPECT_GT(world.contacts(AgentId{kFirstMote}).robots.steps, 0U);
  ASSERT_TRUE(world.set_body_velocity(kRobot, {}).has_value());
  run(200);
  EXPECT_TRUE(world.moved().empty()) << "all sleep again";
}

TEST_P(AwakeWorld, MotorsThatAreSwitchedOffWakeARobot) {
  run(80);
  ASSERT_TRUE(world.set_motors(kRobot, false).has_value());
  step();
  EXPECT_EQ(world.moved_at(kRobot), world.steps());
}

/// A robot that drives through pairs of motes which touch each other, and others far away.
class Pairs {
 public:
  explicit Pairs(int far_away) {
    world.add_robot(kRobot, robertino(hal::node::devices::WheelLevel::kContact), {-1, 0.05, 0});
    const double side = MoteDescription{}.size.x - 1e-5;  // m: they touch
    for (std::uint16_t i = 0; i < kPairs; ++i) {
      add({1.0 * i, 0, 0});
      add({1.0 * i + side, 0, 0});
    }
    for (int i = 0; i < far_away; ++i) add({10.0 + i, 20, 0});
  }

  void add(const hal::Pose2& pose) { world.add_mote(AgentId{next_++}, MoteDescription{}, pose); }

  static constexpr std::uint16_t kPairs = 5;
  static constexpr std::uint16_t kLast = kFirstMote + 2 * kPairs - 1;
  World world{WorldConfig{}};

 private:
  std::uint16_t next_ = kFirstMote;
};

// What is far away does not matter, and neither does it that sleepers are left out of the search
// for contacts if there are many: one that is touched wakes the one that it touches in that step.
TEST(QuietZones, LeaveOutNothingThatWouldBeFound) {
  Pairs few(0), many(100);
  for (int step = 0; step < 1500; ++step) {
    if (step == 100) {
      for (Pairs* pairs : {&few, &many})
        ASSERT_TRUE(pairs->world.set_body_velocity(kRobot, {0.5, 0, 0}).has_value());
    }
    few.world.step();
    many.world.step();
    for (std::uint16_t i = 1; i <= Pairs::kLast; ++i) {
      const AgentId agent{i};
      ASSERT_EQ(few.world.asleep(agent), many.world.asleep(agent)) << i << " in step " << step;
      ASSERT_EQ(few.world.pose(agent).position, many.world.pose(agent).position)
          << i << " in step " << step;
      ASSERT_EQ(few.world.contacts(agent).bodies.steps, many.world.contacts(agent).bodies.steps)
          << i << " in step " << step;
    }
  }
  EXPECT_EQ(few.world.jammed_steps(), many.world.jammed_steps());
  EXPECT_GT(many.world.contacts(AgentId{Pairs::kLast}).robots.steps +
                many.world.contacts(AgentId{Pairs::kLast}).motes.steps,
            0U);
  EXPECT_GT(many.world.contacts(kRobot).motes.steps, 100U);
}

INSTANTIATE_TEST_SUITE_P(Motes, AwakeWorld, testing::Values(3, 90));

}  // namespace
}  // namespace sim::physics::test
