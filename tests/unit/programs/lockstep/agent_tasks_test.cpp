#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <string>

#include "programs/lockstep/kernel_thread.h"

namespace programs::lockstep {
namespace {

/// A process that waits, number 1 of a namespace of process numbers of its own.
class FirstProcess {
 public:
  FirstProcess() {
    holder_ = fork();
    if (holder_ == 0) _exit(hold());
    int status = 0;
    waitpid(holder_, &status, WUNTRACED);
    is_refused_ = !WIFSTOPPED(status);
  }
  ~FirstProcess() {
    if (!is_refused_) end();
  }
  FirstProcess(const FirstProcess&) = delete;
  FirstProcess& operator=(const FirstProcess&) = delete;

  bool is_refused() const { return is_refused_; }
  pid_t holder() const { return holder_; }

  void end() {
    kill(holder_, SIGCONT);
    waitpid(holder_, nullptr, 0);
    is_refused_ = true;
  }

 private:
  /// Starts it, stops, and ends with it.
  static int hold() {
    if (unshare(CLONE_NEWUSER | CLONE_NEWPID) != 0) return EXIT_FAILURE;
    const pid_t first = fork();
    if (first == 0) {
      for (;;) pause();
    }
    raise(SIGSTOP);
    kill(first, SIGKILL);
    waitpid(first, nullptr, 0);
    return EXIT_SUCCESS;
  }

  pid_t holder_ = -1;
  bool is_refused_ = false;
};

TEST(AgentTasks, KnowThreadsByTheirNumbersInside) {
  FirstProcess first;
  if (first.is_refused()) GTEST_SKIP() << "no namespaces here";
  AgentTasks tasks(netns::open_file(
      "/proc/" + std::to_string(first.holder()) + "/ns/pid_for_children", O_RDONLY));
  const pid_t outside = tasks.outside(1);
  ASSERT_GT(outside, 0);
  EXPECT_EQ(getpgid(outside), getpgid(0));
  EXPECT_EQ(tasks.find(1, 1).process(), outside);
  EXPECT_EQ(tasks.find(1, 1).thread(), outside);
  EXPECT_FALSE(tasks.has_ended(1));
  for (const pid_t other : {2, 4711}) {
    EXPECT_EQ(tasks.outside(other), 0);
    EXPECT_EQ(tasks.find(1, other).look(), KernelState::kGone);
  }
  first.end();
  tasks.forget(1);
  EXPECT_EQ(tasks.outside(1), 0);
  EXPECT_EQ(tasks.find(1, 1).look(), KernelState::kGone);
  EXPECT_TRUE(tasks.has_ended(1));
}

}  // namespace
}  // namespace programs::lockstep
