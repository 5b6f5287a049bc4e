#include "results/record/movable_log.h"

#include <gtest/gtest.h>

#include "results/record/recorder.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using namespace std::chrono_literals;
using hal::Time;
using sim::physics::Movable;

sim::physics::BodyPose at_x(double x) { return {.position = {x, 0, 0.5}}; }

// Reported every 100 ms while it moves, until 1.2 s; a row each 500 ms, and where it came to rest.
TEST(MovableLog, HasARowPerPeriodAndWhereAMovableCameToRest) {
  const Folder folder("movable_log");
  NewDatabase database(folder.file());
  database.execute("BEGIN");
  Commits commits(database);
  Movable ball{.name = "ball", .form = sim::physics::MovableSphere{0.5}};
  ball.mass = 3;
  MovableLog log(database, {Movable{.name = "crate"}, ball}, 500ms, commits);
  log.on_movable(Time{}, 0, at_x(9));
  for (int i = 0; i <= 12; ++i) log.on_movable(Time{i * 100ms}, 1, at_x(0.1 * i));
  log.finish(Time{5s});
  commits.commit();
  EXPECT_EQ(ask(folder.file(),
                "SELECT group_concat(at_ns / 1000000) FROM movable_poses "
                "WHERE movable = 1"),
            "0,500,1000,1200");
  EXPECT_EQ(ask(folder.file(), "SELECT x_m FROM movable_poses WHERE at_ns = 1200000000"), "1.2");
  EXPECT_EQ(ask(folder.file(), "SELECT COUNT(*) FROM movable_poses WHERE movable = 0"), "1");
  EXPECT_EQ(
      ask(folder.file(), "SELECT form || size_z_m || mass_kg FROM movables WHERE movable = 1"),
      "sphere1.03.0");
}

}  // namespace
}  // namespace results::record::test
