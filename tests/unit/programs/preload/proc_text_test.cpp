#include "programs/preload/proc_text.h"

#include <gtest/gtest.h>

// The factor is 0.25, from main.cpp, and CLOCK_BOOTTIME's origin at 4000 s.
namespace programs::preload {
namespace {

TEST(ProcFiles, AreKnownByTheirPath) {
  EXPECT_EQ(proc_file("/proc/uptime"), ProcFile::kUptime);
  EXPECT_EQ(proc_file("/proc/stat"), ProcFile::kStat);
  EXPECT_EQ(proc_file("/proc/17/stat"), ProcFile::kProcess);
  EXPECT_EQ(proc_file("/proc/17/task/18/stat"), ProcFile::kProcess);
  for (const char* other : {"", "/proc", "/proc/", "/proc/17", "/proc/17/status", "/proc/x/stat",
                            "/proc/17/task/18", "/proc/17/net/stat", "/procs/uptime", "/tmp/stat",
                            "/proc/net/stat", "/proc/17/task/18/x/stat", "/proc//stat"}) {
    EXPECT_EQ(proc_file(other), std::nullopt) << other;
  }
}

TEST(ProcFiles, MayHideBehindAnyPathThatEndsInTheirName) {
  EXPECT_TRUE(may_be_proc_file("uptime"));
  EXPECT_TRUE(may_be_proc_file("/proc/self/stat"));
  EXPECT_FALSE(may_be_proc_file("/proc/self/status"));
  EXPECT_FALSE(may_be_proc_file("mystat"));
  EXPECT_FALSE(may_be_proc_file(""));
}

TEST(ProcUptime, GoesSlowerFromTheOriginAndSoDoesIdleTime) {
  EXPECT_EQ(as_told(ProcFile::kUptime, "4012.07 800.40\n"), "4003.01 200.10\n");
  EXPECT_EQ(as_told(ProcFile::kUptime, "3999.99 4.00\n"), "3999.99 1.00\n");
  for (const char* other : {"", "\n", "4012\n", "4012.07\n", "x.y z.w\n", "4012.07 800\n"}) {
    EXPECT_EQ(as_told(ProcFile::kUptime, other), other);
  }
}

TEST(ProcStat, TellsSlowedProcessorTimeAndTheRestAsItIs) {
  EXPECT_EQ(as_told(ProcFile::kStat,
                    "cpu  800 40 7 0\ncpu0 400 20 3 0\nintr 800 40\nctxt 800\nbtime 1700000000\n"),
            "cpu  200 10 1 0\ncpu0 100 5 0 0\nintr 800 40\nctxt 800\nbtime 1700000000\n");
  EXPECT_EQ(as_told(ProcFile::kStat, "cpu  8"), "cpu  2");
  EXPECT_EQ(as_told(ProcFile::kStat, ""), "");
}

/// proc(5): fields 14 to 17, 42 to 44 are processor time, 22 is when it started, all in ticks.
TEST(ProcOfAProcess, TellsSlowedProcessorTimeAndStart) {
  const std::string kernel =
      "7 (a) 8 (b) S 4 5 6 7 8 9 10 11 12 13 1400 1500 1600 1700 -18 19 20 21 401200 23 24 25 26 "
      "27 "
      "28 29 30 31 32 33 34 35 36 37 38 39 40 41 4200 4300 -4400 45\n";
  const std::string told =
      "7 (a) 8 (b) S 4 5 6 7 8 9 10 11 12 13 350 375 400 425 -18 19 20 21 400300 23 24 25 26 27 "
      "28 29 30 31 32 33 34 35 36 37 38 39 40 41 1050 1075 -4400 45\n";
  EXPECT_EQ(as_told(ProcFile::kProcess, kernel), told);
  EXPECT_EQ(as_told(ProcFile::kProcess, "no bracket"), "no bracket");
  EXPECT_EQ(as_told(ProcFile::kProcess, "7 (x)"), "7 (x)");
}

}  // namespace
}  // namespace programs::preload
