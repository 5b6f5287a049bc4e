#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/sysinfo.h>
#include <sys/times.h>
#include <sys/wait.h>
#include <unistd.h>

#include <ctime>

#include "tests/unit/programs/preload/recorder/recorder.h"
#include "tests/unit/programs/preload/times.h"

// The factor is 0.25, from main.cpp: a program's 1 s is 4 s of the kernel. CLOCK_MONOTONIC's origin
// is at 1000 s, CLOCK_BOOTTIME's at 4000 s.
namespace programs::preload {
namespace {

constexpr tests::recorder::Reaction kEightSeconds{0, 0, 8 * kSecond, 0};

void expect_seconds(const timeval& time, std::int64_t seconds) {
  EXPECT_EQ(time.tv_sec, seconds);
  EXPECT_EQ(time.tv_usec, 0);
}

TEST(ProcessorTime, IsToldSlowedByEveryCall) {
  tests::recorder::set_clock(8 * kSecond);
  EXPECT_EQ(clock(), 2 * CLOCKS_PER_SEC);
  tests::recorder::disarm();
  rusage usage{};
  tests::recorder::arm(kEightSeconds);
  EXPECT_EQ(getrusage(RUSAGE_SELF, &usage), 0);
  expect_seconds(usage.ru_utime, 2);
  expect_seconds(usage.ru_stime, 2);
  usage = {};
  EXPECT_EQ(syscall(SYS_getrusage, RUSAGE_SELF, &usage), 0);
  expect_seconds(usage.ru_utime, 2);
  tests::recorder::disarm();
}

TEST(ProcessorTime, OfChildrenIsToldWhenOneHasEnded) {
  constexpr pid_t kChild = 77;
  rusage usage{};
  tests::recorder::arm({kChild, 0, 8 * kSecond, 0});
  EXPECT_EQ(wait4(-1, nullptr, 0, &usage), kChild);
  expect_seconds(usage.ru_utime, 2);
  EXPECT_EQ(wait3(nullptr, 0, &usage), kChild);
  expect_seconds(usage.ru_utime, 2);
  EXPECT_EQ(wait4(-1, nullptr, 0, nullptr), kChild);
  tests::recorder::disarm();
  tests::recorder::arm(kEightSeconds);
  EXPECT_EQ(wait4(-1, nullptr, WNOHANG, &usage), 0);
  expect_seconds(usage.ru_utime, 8);  // the recorder's: of no child the kernel tells nothing
  tests::recorder::disarm();
}

TEST(Times, CountsTicksOfTheSlowedClockAndOfProcessorTime) {
  tests::recorder::arm(kEightSeconds);
  tests::recorder::set_clock(1008 * kSecond);
  tms usage{};
  EXPECT_EQ(times(&usage), 1002 * 100);
  EXPECT_EQ(usage.tms_utime, 200);
  EXPECT_EQ(usage.tms_stime, 200);
  EXPECT_EQ(usage.tms_cutime, 200);
  EXPECT_EQ(usage.tms_cstime, 200);
  EXPECT_EQ(times(nullptr), 1002 * 100);
  EXPECT_EQ(syscall(SYS_times, &usage), 1002 * 100);
  tests::recorder::disarm();
}

TEST(Sysinfo, TellsTheSlowedTimeSinceTheStartRoundedUp) {
  tests::recorder::set_clock(4009 * kSecond);
  struct sysinfo told {};
  EXPECT_EQ(sysinfo(&told), 0);
  EXPECT_EQ(told.uptime, 4003);
  tests::recorder::disarm();
}

#ifndef __SANITIZE_ADDRESS__  // see processor_time.cpp
TEST(LimitOfProcessorTime, IsOfTheProgramsOwnSeconds) {
  tests::recorder::arm({0, 0, 12, 0});
  const rlimit three{3, RLIM_INFINITY};
  setrlimit(RLIMIT_CPU, &three);
  rlimit told{};
  getrlimit(RLIMIT_CPU, &told);
  EXPECT_EQ(told.rlim_cur, 3U);
  EXPECT_EQ(told.rlim_max, RLIM_INFINITY);
  setrlimit(RLIMIT_NOFILE, &three);
  getrlimit(RLIMIT_NOFILE, &told);
  EXPECT_EQ(told.rlim_cur, 12U) << "a number of files";
  const auto calls = tests::recorder::disarm();
  ASSERT_EQ(calls.size(), 4U);
  constexpr auto kInfinity = static_cast<std::int64_t>(RLIM_INFINITY);
  EXPECT_EQ(calls[0].times, (std::vector<std::int64_t>{12, kInfinity}));
  EXPECT_EQ(calls[2].times, (std::vector<std::int64_t>{3, kInfinity}));
}
#endif

}  // namespace
}  // namespace programs::preload
