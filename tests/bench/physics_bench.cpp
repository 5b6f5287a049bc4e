#include <fmt/format.h>
#include <sys/resource.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "hal/types/math.h"
#include "hal/types/random.h"
#include "sim/physics/world.h"
#include "tests/unit/sim/physics/heap.h"

/// What physics costs, beside peer/ode/speed of the same n, m, spacing and model:
///
///   physics_bench [n=12] [m=25] [b=0] [model=0|1] [T=600] [spacing=2]
///                                       robots, motes and movable boxes of 0.25 m, 1 kg in a yard
///   physics_bench heap [model=0|1]                                slowest step in a heap of twenty
///
/// model 0: jointed, 1: contact. The robots carry the peer's bodies (see peers_robot).
namespace sim::physics::test {
namespace {

using hal::node::devices::RobotDescription;
using hal::node::devices::WheelLevel;

double thread_cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double user_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// 5 kg in two cylinders on three wheels of 0.3 kg at 0, 120 and 240 degrees, 0.3 N m each;
/// commands reach the motors at once, as the peer's do.
RobotDescription peers_robot(WheelLevel level) {
  RobotDescription robot;
  robot.model = "peer";
  robot.wheel_level = level;
  robot.cylinders = {{0.18, 0.02, 0.20, {}, 3.5}, {0.09, 0.20, 0.42, {}, 1.5}};
  robot.friction = 0.3;
  for (int i = 0; i < 3; ++i) {
    const double heading = 2 * hal::math::kPi * i / 3;
    const hal::Vec2 place = 0.155 * hal::Vec2{hal::math::cos(heading), hal::math::sin(heading)};
    robot.wheels.push_back({place, heading, 0.04, 0.3, 0.6, 0, 0.3, 50});
  }
  robot.acceleration = {1e6, 1e6, 1e6, 1e6};
  return robot;
}

struct Options {
  int n = 12, m = 25, b = 0, model = 0;
  double seconds = 600, spacing = 2;
  bool heap = false;
};

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    const std::size_t equals = argument.find('=');
    const std::string_view key = argument.substr(0, equals);
    const double value = equals == std::string_view::npos ? 1 : std::atof(argv[i] + equals + 1);
    if (key == "n") options.n = static_cast<int>(value);
    if (key == "m") options.m = static_cast<int>(value);
    if (key == "b") options.b = static_cast<int>(value);
    if (key == "model") options.model = static_cast<int>(value);
    if (key == "T") options.seconds = value;
    if (key == "spacing") options.spacing = value;
    if (key == "heap") options.heap = true;
  }
  return options;
}

AgentId member(int i) { return AgentId{static_cast<std::uint16_t>(i + 1)}; }

void add_member(World& world, const Options& options, int i, const hal::Pose2& pose) {
  const WheelLevel level = options.model == 1 ? WheelLevel::kContact : WheelLevel::kJointed;
  if (i < options.n) return world.add_robot(member(i), peers_robot(level), pose);
  if (i < options.n + options.m) return world.add_mote(member(i), {}, pose);
  Movable box{.name = "box", .form = MovableBox{{0.25, 0.25, 0.25}}};
  box.pose = pose;
  world.add_movable(box);
}

/// A grid in a walled yard, robots, motes and boxes mixed by a shuffle.
void populate(World& world, const Options& options, hal::RandomStream& random) {
  const int all = options.n + options.m + options.b;
  const int side = static_cast<int>(std::ceil(std::sqrt(all)));
  const double half = side * options.spacing / 2 + 1;
  std::vector<int> cells;
  for (int i = 0; i < side * side; ++i) cells.push_back(i);
  for (std::size_t i = cells.size() - 1; i > 0; --i)
    std::swap(cells[i], cells[random.below(static_cast<std::uint32_t>(i + 1))]);
  for (int i = 0; i < all; ++i) {
    const int cell = cells[static_cast<std::size_t>(i)];
    const hal::Pose2 pose{(cell % side - 0.5 * (side - 1)) * options.spacing,
                          (cell / side - 0.5 * (side - 1)) * options.spacing,
                          6.28 * random.uniform()};
    add_member(world, options, i, pose);
  }
  world.add_wall({"east", {half, 0, 0.25}, {0.2, 2 * half, 0.5}});
  world.add_wall({"west", {-half, 0, 0.25}, {0.2, 2 * half, 0.5}});
  world.add_wall({"north", {0, half, 0.25}, {2 * half, 0.2, 0.5}});
  world.add_wall({"south", {0, -half, 0.25}, {2 * half, 0.2, 0.5}});
}

/// Each robot gets another command once a second, not all in the same step.
void command(World& world, int robots, hal::RandomStream& random) {
  const auto between = [&](double a) { return a * (2 * random.uniform() - 1); };
  for (int i = 0; i < robots; ++i) {
    if ((world.steps() + 7 * static_cast<std::uint64_t>(i)) % 100 != 0) continue;
    (void)world.set_body_velocity(member(i), {between(0.3), between(0.3), between(1)});
  }
}

void run_yard(const Options& options) {
  hal::RandomStream random(1, "physics_bench");
  World world(WorldConfig{});
  populate(world, options, random);
  const auto go = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      command(world, options.n, random);
      world.step();
    }
  };
  go(100);
  const double before = user_seconds();
  const int steps = static_cast<int>(100 * options.seconds);
  go(steps);
  const double used = user_seconds() - before;
  fmt::print("n={} m={} b={} model={} | user {:.3f} s, {:.1f} us/step | RTF {:.1f} | jams {}\n",
             options.n, options.m, options.b, options.model, used, 1e6 * used / steps,
             options.seconds / used, world.jammed_steps());
}

void run_heap(const Options& options) {
  Heap heap(options.model == 1 ? WheelLevel::kContact : WheelLevel::kJointed);
  double slowest = 0;
  const double before = thread_cpu_seconds();
  for (int k = 0; k < 6000; ++k) {
    const double start = thread_cpu_seconds();
    heap.step(+1);
    slowest = std::max(slowest, thread_cpu_seconds() - start);
  }
  fmt::print("heap of {} model={} | slowest step {:.3f} ms | mean {:.1f} us | tilt {:.1e} rad\n",
             Heap::kRobots, options.model, 1e3 * slowest,
             1e6 * (thread_cpu_seconds() - before) / 6000, heap.worst_tilt());
}

}  // namespace
}  // namespace sim::physics::test

int main(int argc, char** argv) {
  const auto options = sim::physics::test::parse(argc, argv);
  if (options.heap)
    sim::physics::test::run_heap(options);
  else
    sim::physics::test::run_yard(options);
}
