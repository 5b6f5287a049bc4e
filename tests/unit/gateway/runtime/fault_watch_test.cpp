#include "gateway/runtime/fault_watch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stdexcept>
#include <thread>

#include "hal/node/exchange/foreign_call.h"

namespace gateway::runtime {
namespace {

using testing::KilledBySignal;

constexpr hal::Time kTwo{std::chrono::seconds{2}};

/// Does something in a call that is watched.
void in_step(const std::function<void()>& something, bool held = false) {
  const FaultWatch watch("error", held);
  const hal::node::exchange::ForeignCall step("controller of r0", "step()", kTwo);
  something();
}

TEST(FaultWatchDeathTest, NamesEverySignalTheControllerAndTheCall) {
  for (const auto& [signal, name] : {std::pair{SIGABRT, "SIGABRT"},
                                     {SIGSYS, "SIGSYS"},
                                     {SIGXCPU, "SIGXCPU"},
                                     {SIGXFSZ, "SIGXFSZ"},
                                     {SIGALRM, "SIGALRM"},
                                     {SIGPIPE, "SIGPIPE"},
                                     {SIGUSR1, "SIGUSR1"}}) {
    EXPECT_EXIT(in_step([number = signal] { std::raise(number); }), KilledBySignal(signal),
                "^error: controller of r0: " + std::string(name) +
                    " \\([A-Z].*\\) in step\\(\\) at 2.000000000 s\n$");
  }
}

TEST(FaultWatchDeathTest, NamesTheAddressOfANullPointer) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the sanitizer handles this signal itself";
#else
  volatile int* volatile nowhere = nullptr;
  EXPECT_EXIT(in_step([&] { *nowhere = 1; }), KilledBySignal(SIGSEGV),
              "^error: controller of r0: SIGSEGV .* at address 0x0 in step");
#endif
}

TEST(FaultWatchDeathTest, TellsWhatNobodyCaughtAndWhichCallWasUnderWay) {
  const auto throw_aside = [] {
    std::thread([] { throw std::runtime_error("\033[2Jit fell"); }).join();
  };
  EXPECT_EXIT(in_step(throw_aside), KilledBySignal(SIGABRT),
              "^error: uncaught exception std::runtime_error: \\\\x1b\\[2Jit fell on another "
              "thread during step\\(\\) of controller of r0 at 2.000000000 s\n$");
  EXPECT_EXIT(in_step([] { std::thread([] { throw 3; }).join(); }), KilledBySignal(SIGABRT),
              "uncaught exception int on another thread");
}

TEST(FaultWatchDeathTest, SaysThatNoCallWasUnderWay) {
  const auto outside = [] {
    const FaultWatch watch("motes");
    std::raise(SIGUSR2);
  };
  EXPECT_EXIT(outside(), KilledBySignal(SIGUSR2),
              "^motes: SIGUSR2 .* outside any call of a controller\n$");
}

TEST(FaultWatchDeathTest, LeavesAReaderThatLeftAndAForkedChildAlone) {
  const auto no_reader = [] {
    const FaultWatch watch("error");
    std::raise(SIGPIPE);
  };
  EXPECT_EXIT(no_reader(), KilledBySignal(SIGPIPE), "^$");
  const auto forked = [] {
    const pid_t pid = fork();
    if (pid == 0) std::raise(SIGUSR1);
    int status = 0;
    waitpid(pid, &status, 0);
    ::_exit(WIFSIGNALED(status) && WTERMSIG(status) == SIGUSR1 ? 0 : 1);
  };
  EXPECT_EXIT(in_step(forked), testing::ExitedWithCode(0), "^$");
}

TEST(FaultWatchDeathTest, NamesWhoSentTheSignal) {
  const auto sent = [] {
    const pid_t parent = getpid();
    if (fork() == 0) {
      kill(parent, SIGUSR1);
      ::_exit(0);
    }
    while (true) pause();
  };
  EXPECT_EXIT(in_step(sent), KilledBySignal(SIGUSR1), "SIGUSR1 .* from process [0-9]+ in step");
}

TEST(FaultWatchDeathTest, HoldsTheThreadUntilResultsAreWritten) {
  const auto held = [] {
    std::thread([] {
      while (!FaultWatch::held_fault()) std::this_thread::yield();
      const std::string text = "written of: " + *FaultWatch::held_fault() + "\n";
      if (::write(STDERR_FILENO, text.data(), text.size()) < 0) ::_exit(1);
      FaultWatch::end();
    }).detach();
    in_step([] { std::raise(SIGUSR1); }, true);
  };
  EXPECT_EXIT(held(), KilledBySignal(SIGUSR1),
              "error: controller of r0: SIGUSR1.*\nwritten of: controller of r0: SIGUSR1");
}

TEST(FaultWatchDeathTest, DoesNotWaitForEverForResults) {
  EXPECT_EXIT(in_step([] { std::raise(SIGUSR1); }, true), KilledBySignal(SIGUSR1), "SIGUSR1");
}

TEST(FaultWatchDeathTest, LeavesSignalsThatAreHandledAndIsOverWithItsLife) {
  const auto handled = [] {
    std::signal(SIGUSR1, SIG_IGN);
    in_step([] { std::raise(SIGUSR1); });
    std::signal(SIGUSR1, SIG_DFL);
    in_step([] {});
    std::raise(SIGUSR1);
  };
  EXPECT_EXIT(handled(), KilledBySignal(SIGUSR1), "^$");
}

TEST(SignalStacks, LeaveNoneOfAnEndedOneBehind) {
  stack_t before{}, between{}, after{};
  ::sigaltstack(nullptr, &before);
  auto first = std::make_unique<SignalStack>();
  ::sigaltstack(nullptr, &between);
  EXPECT_NE(between.ss_sp, before.ss_sp);
  auto second = std::make_unique<SignalStack>();
  first.reset();
  second.reset();
  ::sigaltstack(nullptr, &after);
  EXPECT_EQ(after.ss_sp, before.ss_sp);
}

}  // namespace
}  // namespace gateway::runtime
