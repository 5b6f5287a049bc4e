#include "gateway/process/limits.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <functional>
#include <stdexcept>
#include <string>

namespace gateway::process {
namespace {

/// What is thrown, or nothing, under limits of open files that end with the process: in a child.
std::string under_file_limits(rlim_t soft, rlim_t hard, const std::function<void()>& action) {
  int pipes[2];
  if (pipe(pipes) != 0) return "no pipe";
  if (fork() == 0) {
    const rlimit limits{soft, hard};
    setrlimit(RLIMIT_NOFILE, &limits);
    std::string thrown;
    try {
      action();
    } catch (const std::exception& error) {
      thrown = error.what();
    }
    _exit(write(pipes[1], thrown.data(), thrown.size()) < 0 ? 1 : 0);
  }
  close(pipes[1]);
  wait(nullptr);
  char text[4096];
  const ssize_t size = read(pipes[0], text, sizeof text);
  close(pipes[0]);
  return {text, static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

TEST(Limits, TheSoftLimitOfOpenFilesIsRaisedAsFarAsNeeded) {
  EXPECT_EQ(under_file_limits(256, 4096,
                              [] {
                                make_room_for(200);
                                rlimit now{};
                                getrlimit(RLIMIT_NOFILE, &now);
                                if (now.rlim_cur <= 256) throw std::runtime_error("not raised");
                                if (now.rlim_cur > 4096) throw std::runtime_error("too far");
                              }),
            "");
}

TEST(Limits, AHardLimitThatIsTooLowIsNamedWithWhatIsNeededAndHowToRaiseIt) {
  const std::string thrown = under_file_limits(64, 64, [] { make_room_for(200); });
  EXPECT_NE(thrown.find("200 controller processes need"), std::string::npos) << thrown;
  EXPECT_NE(thrown.find("the limit is 64"), std::string::npos) << thrown;
  EXPECT_NE(thrown.find("ulimit -Hn"), std::string::npos) << thrown;
}

TEST(Limits, EnoughIsLeftAlone) {
  EXPECT_EQ(under_file_limits(1024, 4096, [] { make_room_for(2); }), "");
}

TEST(Limits, WhatForkCannotHaveIsNamedByItsLimit) {
  EXPECT_NE(limit_met(EAGAIN).find("ulimit -u"), std::string::npos);
  EXPECT_NE(limit_met(EMFILE).find("ulimit -n"), std::string::npos);
  EXPECT_NE(limit_met(ENFILE).find("fs.file-max"), std::string::npos);
  EXPECT_EQ(limit_met(ENOENT), "No such file or directory");
}

}  // namespace
}  // namespace gateway::process
