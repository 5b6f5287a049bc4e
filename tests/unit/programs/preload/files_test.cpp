#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utime.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <string>

#include "tests/unit/programs/preload/times.h"

// The factor is 0.25, from main.cpp: a program's 1 s is 4 s of the kernel. CLOCK_REALTIME's origin
// is at 2000 s.
namespace programs::preload {
namespace {

constexpr std::int64_t kOrigin = 2000 * kSecond;

class FileTimes : public testing::Test {
 protected:
  FileTimes() : file_(mkstemp(name_.data())) {}
  ~FileTimes() override {
    close(file_);
    unlink(path());
  }
  const char* path() const { return name_.c_str(); }

  /// Past the calls that convert.
  struct stat of_kernel() const {
    struct stat told {};
    EXPECT_EQ(syscall(SYS_newfstatat, AT_FDCWD, path(), &told, 0), 0);
    return told;
  }

  std::string name_ = testing::TempDir() + "baraka-file-times-XXXXXX";
  int file_;
};

TEST_F(FileTimes, ThatAProgramGivesAreWhatItReads) {
  const std::array given{at(kOrigin + 3 * kSecond + 1), at(kOrigin + 5 * kSecond)};
  ASSERT_EQ(utimensat(AT_FDCWD, path(), given.data(), 0), 0);
  EXPECT_EQ(ns(of_kernel().st_atim), kOrigin + 12 * kSecond + 4);
  EXPECT_EQ(ns(of_kernel().st_mtim), kOrigin + 20 * kSecond);
  struct stat told {};
  ASSERT_EQ(stat(path(), &told), 0);
  EXPECT_EQ(ns(told.st_atim), ns(given[0]));
  EXPECT_EQ(ns(told.st_mtim), ns(given[1]));
}

TEST_F(FileTimes, FromBeforeTheOriginStay) {
  const std::array given{at(kOrigin - 3 * kSecond), at(7)};
  ASSERT_EQ(futimens(file_, given.data()), 0);
  EXPECT_EQ(ns(of_kernel().st_atim), ns(given[0]));
  struct stat told {};
  ASSERT_EQ(fstat(file_, &told), 0);
  EXPECT_EQ(ns(told.st_atim), ns(given[0]));
  EXPECT_EQ(ns(told.st_mtim), 7);
}

/// 20 s of the kernel after the origin are 5 s of the program.
TEST_F(FileTimes, AreToldAlikeByEveryCall) {
  const std::array given{at(kOrigin + 5 * kSecond), at(kOrigin + 5 * kSecond)};
  ASSERT_EQ(utimensat(AT_FDCWD, path(), given.data(), 0), 0);
  struct stat told {};
  struct stat64 large {};
  const auto expect = [&](int status) {
    EXPECT_EQ(status, 0);
    EXPECT_TRUE(ns(told.st_mtim) == kOrigin + 5 * kSecond ||
                ns(large.st_mtim) == kOrigin + 5 * kSecond);
    told = {};
    large = {};
  };
  expect(stat(path(), &told));
  expect(lstat(path(), &told));
  expect(fstat(file_, &told));
  expect(fstatat(AT_FDCWD, path(), &told, 0));
  expect(stat64(path(), &large));
  expect(lstat64(path(), &large));
  expect(fstat64(file_, &large));
  expect(fstatat64(AT_FDCWD, path(), &large, 0));
  for (const bool raw : {false, true}) {
    struct statx extended {};
    EXPECT_EQ(raw ? syscall(SYS_statx, AT_FDCWD, path(), 0, STATX_BASIC_STATS, &extended)
                  : statx(AT_FDCWD, path(), 0, STATX_BASIC_STATS, &extended),
              0);
    EXPECT_EQ(extended.stx_mtime.tv_sec, 2005);
    EXPECT_EQ(extended.stx_mtime.tv_nsec, 0U);
  }
}

TEST_F(FileTimes, AreGivenAlikeByEveryCall) {
  const utimbuf seconds{2003, 2005};
  const std::array<timeval, 2> microseconds{timeval{2003, 0}, timeval{2005, 0}};
  const std::function<int()> calls[] = {
      [&] { return utime(path(), &seconds); },
      [&] { return utimes(path(), microseconds.data()); },
      [&] { return lutimes(path(), microseconds.data()); },
      [&] { return futimes(file_, microseconds.data()); },
      [&] { return futimesat(AT_FDCWD, path(), microseconds.data()); },
      [&] { return futimesat(file_, nullptr, microseconds.data()); }};
  for (const auto& call : calls) {
    const std::array zero{at(0), at(0)};
    ASSERT_EQ(futimens(file_, zero.data()), 0);
    EXPECT_EQ(call(), 0);
    EXPECT_EQ(ns(of_kernel().st_atim), kOrigin + 12 * kSecond);
    EXPECT_EQ(ns(of_kernel().st_mtim), kOrigin + 20 * kSecond);
  }
}

/// The kernel stamps with the time of its last tick, some milliseconds ago.
TEST_F(FileTimes, OfJustNowAreOfJustNow) {
  const std::array zero{at(0), at(0)};
  const std::array now_and_never{timespec{0, UTIME_NOW}, timespec{0, UTIME_OMIT}};
  const std::function<bool()> ways[] = {
      [&] { return write(file_, "x", 1) == 1; }, [&] { return futimens(file_, nullptr) == 0; },
      [&] { return utime(path(), nullptr) == 0; },
      [&] { return utimensat(AT_FDCWD, path(), now_and_never.data(), 0) == 0; }};
  for (const auto& way : ways) {
    ASSERT_EQ(futimens(file_, zero.data()), 0);
    timespec before{}, after{};
    clock_gettime(CLOCK_REALTIME_COARSE, &before);
    EXPECT_TRUE(way());
    clock_gettime(CLOCK_REALTIME, &after);
    struct stat told {};
    ASSERT_EQ(stat(path(), &told), 0);
    const std::int64_t newest = std::max(ns(told.st_atim), ns(told.st_mtim));
    EXPECT_GE(newest, ns(before));
    EXPECT_LE(newest, ns(after));
  }
}

/// Seconds since the computer's start, as CLOCK_BOOTTIME has it, too.
double since_start() {
  timespec now{};
  clock_gettime(CLOCK_BOOTTIME, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double first_number(int descriptor) {
  std::array<char, 64> text{};
  EXPECT_GT(read(descriptor, text.data(), text.size() - 1), 0);
  return std::strtod(text.data(), nullptr);
}

/// By a hundredth of a second, as much again as it takes, and rounding.
constexpr double kSoon = 0.03;

void expect_now(const std::function<double()>& read_uptime) {
  const double before = since_start();
  const double told = read_uptime();
  EXPECT_GE(told, before - kSoon);
  EXPECT_LE(told, since_start() + kSoon);
}

TEST(ProcUptimeFile, IsTheProgramsHoweverItIsOpened) {
  const auto by = [](int descriptor) {
    EXPECT_GE(descriptor, 0);
    const double told = first_number(descriptor);
    close(descriptor);
    return told;
  };
  expect_now([&] { return by(open("/proc/uptime", O_RDONLY)); });
  expect_now([&] { return by(open64("/proc/uptime", O_RDONLY | O_CLOEXEC)); });
  const int folder = open("/proc/self", O_RDONLY | O_DIRECTORY);
  expect_now([&] { return by(openat(folder, "../uptime", O_RDONLY)); });
  expect_now([&] { return by(openat64(folder, "../uptime", O_RDONLY)); });
  close(folder);
  expect_now([] {
    double told = 0;
    std::ifstream("/proc/uptime") >> told;
    return told;
  });
}

TEST(ProcUptimeFile, IsReadAnewFromItsBeginning) {
  const int file = open("/proc/uptime", O_RDONLY);
  FILE* const stream = fopen("/proc/uptime", "re");
  ASSERT_NE(stream, nullptr);
  EXPECT_EQ(fcntl(fileno(stream), F_GETFD), FD_CLOEXEC);
  EXPECT_EQ(fcntl(file, F_GETFD), 0);
  double first = 0, second = 0;
  ASSERT_EQ(fscanf(stream, "%lf", &first), 1);
  const double read_first = first_number(file);
  usleep(60'000);
  expect_now([&] {
    lseek(file, 0, SEEK_SET);
    return first_number(file);
  });
  fflush(stream);
  rewind(stream);
  ASSERT_EQ(fscanf(stream, "%lf", &second), 1);
  EXPECT_GE(second, first + 0.05);
  EXPECT_GE(second, read_first + 0.05);
  fclose(stream);
  close(file);
}

/// A process that starts now starts at the time since the computer's start.
TEST(ProcStatFile, TellsWhenAProcessHasStarted) {
  const double before = since_start();
  const pid_t child = fork();
  if (child == 0) pause();
  const double after = since_start();
  std::ifstream file("/proc/" + std::to_string(child) + "/stat");
  std::string word;
  for (int i = 1; i <= 22; ++i) file >> word;
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_GE(std::stod(word) / 100, before - kSoon) << word;
  EXPECT_LE(std::stod(word) / 100, after + kSoon) << word;
}

}  // namespace
}  // namespace programs::preload
