#include "programs/lockstep/kernel_thread.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace programs::lockstep {
namespace {

/// A process of two threads, of which the first one sleeps.
class TwoThreads {
 public:
  explicit TwoThreads(bool other_runs) : process_(fork()) {
    if (process_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::thread other([other_runs] {
      volatile bool is_spinning = other_runs;
      while (is_spinning) continue;
      for (;;) pause();
    });
    for (;;) pause();
  }
  ~TwoThreads() {
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
  }
  TwoThreads(const TwoThreads&) = delete;
  TwoThreads& operator=(const TwoThreads&) = delete;

  /// Whether this is so at last, with the first thread asleep.
  bool comes_to(bool others_are_awake) const {
    const KernelThread first(process_, process_);
    for (int i = 0; i < 3000; ++i) {
      const bool sleeps = first.look() == KernelState::kAsleep;
      if (sleeps && first.has_others_awake() == others_are_awake) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

 private:
  pid_t process_;
};

TEST(KernelThread, KnowsWhetherAnotherOneOfItsProcessIsAwake) {
  EXPECT_TRUE(TwoThreads(true).comes_to(true));
  const TwoThreads asleep(false);
  EXPECT_TRUE(asleep.comes_to(false));
  EXPECT_FALSE(KernelThread().has_others_awake());
}

}  // namespace
}  // namespace programs::lockstep
