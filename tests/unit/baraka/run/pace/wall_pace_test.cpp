#include "baraka/run/pace/wall_pace.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>

#include "baraka/run/pace/real_time_clock.h"
#include "tests/support/fake_clock.h"
#include "tests/support/printers.h"

/// What goes by the clock of the wall, by one that goes only while it is waited for.
namespace baraka::run::pace {
namespace {

using namespace std::chrono_literals;
using hal::Time;

/// A run with an event every 10 ms up to `end`, as Simulation::run() asks its pace.
void run(WallPace& pace, Time end) {
  for (Time next{10ms}; next <= end; next += 10ms) {
    while (pace.may_go_on(next, {}) == WallPace::Verdict::kAskAgain) continue;
  }
}

TEST(WallPace, RunsNoFasterThanItsFactor) {
  for (const double factor : {0.5, 1.0, 4.0}) {
    tests::FakeClock clock;
    WallPace pace({.max_speed = factor, .once_a_second = [] {}}, clock);
    run(pace, Time{20s});
    // What is not worth sleeping for is left out.
    EXPECT_NEAR(hal::to_seconds(clock.now()), 20 / factor, 1e-3) << factor;
    EXPECT_NEAR(pace.wall_seconds(), 20 / factor, 1e-3) << factor;
  }
}

TEST(WallPace, WaitsForNothingWithoutAFactor) {
  tests::FakeClock clock;
  WallPace pace({.once_a_second = [] {}}, clock);
  run(pace, Time{1000s});
  EXPECT_EQ(clock.now(), Time{});
  EXPECT_EQ(pace.wall_seconds(), 0);
}

TEST(WallPace, AsksAgainAtLeastEvery50MillisecondsThatItWaits) {
  tests::FakeClock clock;
  WallPace pace({.max_speed = 1, .once_a_second = [] {}}, clock);
  int asked = 0;
  while (pace.may_go_on(Time{1s}, {}) == WallPace::Verdict::kAskAgain) ++asked;
  EXPECT_EQ(asked, 20);
}

TEST(WallPace, DoesOnceASecondOfTheWallWhatItIsTold) {
  tests::FakeClock clock;
  int done = 0;
  WallPace pace({.max_speed = 10, .once_a_second = [&] { ++done; }}, clock);
  run(pace, Time{99s});
  EXPECT_EQ(done, 9);
}

TEST(WallPace, ShowsALineEvery10Seconds) {
  tests::FakeClock clock;
  WallPace pace({.max_speed = 2, .processes = 3, .once_a_second = [] {}}, clock);
  testing::internal::CaptureStderr();
  for (Time next{10ms}; next <= Time{50s}; next += 10ms) {
    while (pace.may_go_on(next, {.now = next}) == WallPace::Verdict::kAskAgain) continue;
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(said, '\n'), 2) << said;
  EXPECT_NE(said.find(" 20.0 s simulated, 2 x real time, 0 events, 0 exchanges, 3 controller "
                      "processes\n"),
            std::string::npos)
      << said;
}

/// What is shown of a run at twice real time after 10 s and after 20 s.
std::string shown(Time end, bool may_end_earlier) {
  tests::FakeClock clock;
  WallPace pace(
      {.max_speed = 2, .end = end, .may_end_earlier = may_end_earlier, .once_a_second = [] {}},
      clock);
  testing::internal::CaptureStderr();
  for (Time next{10ms}; next <= Time{50s}; next += 10ms) {
    while (pace.may_go_on(next, {.now = next}) == WallPace::Verdict::kAskAgain) continue;
  }
  return testing::internal::GetCapturedStderr();
}

TEST(WallPace, ShowsTheShareAndTheRestOfARunWhoseEndIsKnown) {
  const std::string said = shown(Time{100s}, false);
  EXPECT_NE(said.find(" 20.0 of 100.0 s simulated (20 %), 40 s left, 2 x real time"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find(" 40.0 of 100.0 s simulated (40 %), 30 s left, 2 x real time"),
            std::string::npos)
      << said;
  const std::string long_run = shown(Time{3620s}, true);
  EXPECT_NE(long_run.find(" 20.0 of at most 3620.0 s simulated (1 %), at most 30 min left, "),
            std::string::npos)
      << long_run;
}

TEST(WallPace, EstimatesNothingInTheFirstSeconds) {
  tests::FakeClock clock;
  WallPace pace({.max_speed = 2, .terminal = true, .end = Time{100s}, .once_a_second = [] {}},
                clock);
  testing::internal::CaptureStderr();
  for (Time next{10ms}; next <= Time{9s}; next += 10ms) {
    while (pace.may_go_on(next, {.now = next}) == WallPace::Verdict::kAskAgain) continue;
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find(" of 100.0 s simulated (8 %), 2 x"), std::string::npos) << said;
  EXPECT_EQ(said.find("left"), std::string::npos) << said;
}

TEST(RealTimeClock, GoesAFactorFasterThanTheWallAndWaitsInSlices) {
  tests::FakeClock clock;
  WallPace pace({.once_a_second = [] {}}, clock);
  RealTimeClock real_time(4, pace);
  EXPECT_EQ(real_time.now(), Time{});
  int waits = 0;
  for (; real_time.now() < Time{10s}; ++waits) EXPECT_TRUE(real_time.wait(Time{10s}, {}, {}));
  EXPECT_EQ(clock.now(), Time{2500ms});
  EXPECT_EQ(waits, 50);
  EXPECT_TRUE(real_time.wait(Time{9s}, {}, {})) << "in the past";
  EXPECT_EQ(clock.now(), Time{2500ms});
}

TEST(RealTimeClock, IsWokenByADescriptor) {
  tests::FakeClock clock;
  WallPace pace({.once_a_second = [] {}}, clock);
  RealTimeClock real_time(1, pace);
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  ASSERT_EQ(write(ends[1], "x", 1), 1);
  EXPECT_EQ(real_time.now(), Time{});
  EXPECT_TRUE(real_time.wait(Time{10s}, std::array{-1, ends[0]}, {}));
  EXPECT_EQ(clock.now(), Time{}) << "no time has passed";
  close(ends[0]), close(ends[1]);
}

}  // namespace
}  // namespace baraka::run::pace
