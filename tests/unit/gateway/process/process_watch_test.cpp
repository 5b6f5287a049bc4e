#include "gateway/process/process_watch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "gateway/process/waiting.h"

namespace gateway::process {
namespace {

/// A child that does nothing, or ends with a status at once.
class Idle {
 public:
  explicit Idle(int exit_status = -1) : pid_(fork()) {
    if (pid_ != 0) return;
    if (exit_status >= 0) _exit(exit_status);
    while (true) pause();
  }
  ~Idle() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Idle(const Idle&) = delete;
  Idle& operator=(const Idle&) = delete;

  /// Who it is; its start time is the one of the file, so this is how a Hello comes to it.
  ProcessIdentity identity() const {
    ProcessIdentity identity = this_process();
    identity.pid = pid_;
    int field = 0;
    std::string text;
    FILE* file = std::fopen(("/proc/" + std::to_string(pid_) + "/stat").c_str(), "r");
    for (char word[256]; ++field <= 22 && std::fscanf(file, "%255s", word) == 1;) text = word;
    std::fclose(file);
    identity.start_time = std::stoull(text);
    return identity;
  }
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_;
};

void expect_death(const ProcessWatch& watch, const std::string& cause) {
  // 5 s: the kernel needs microseconds; a busy machine may take its time.
  EXPECT_TRUE(wait_readable(std::array{watch.descriptor()}, std::chrono::seconds{5}));
  EXPECT_TRUE(watch.is_dead());
  EXPECT_EQ(watch.cause(), cause);
}

TEST(ProcessWatch, SeesThatAProcessWasKilledAndByWhat) {
  const Idle child;
  const ProcessWatch watch(child.identity());
  EXPECT_TRUE(watch.is_local());
  EXPECT_FALSE(watch.is_dead());
  kill(child.pid(), SIGKILL);
  expect_death(watch, "killed by signal 9");
}

TEST(ProcessWatch, SeesTheExitStatus) {
  const Idle child(7);
  expect_death(ProcessWatch(child.identity()), "exited with status 7");
}

TEST(ProcessWatch, StoppedIsNotDead) {
  const Idle child;
  const ProcessWatch watch(child.identity());
  kill(child.pid(), SIGSTOP);
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(child.pid()), &info, WSTOPPED | WNOWAIT);
  EXPECT_FALSE(watch.is_dead());
}

TEST(ProcessWatch, RecycledPidIsDead) {
  const Idle child;
  ProcessIdentity earlier = child.identity();
  --earlier.start_time;
  const ProcessWatch watch(earlier);
  EXPECT_TRUE(watch.is_dead());
  EXPECT_EQ(watch.cause(), "is gone");
}

TEST(ProcessWatch, KnowsNothingOfOtherHosts) {
  ProcessIdentity identity = this_process();
  identity.host = "elsewhere";
  const ProcessWatch watch(identity);
  EXPECT_FALSE(watch.is_local());
  EXPECT_FALSE(watch.is_dead());
}

}  // namespace
}  // namespace gateway::process
