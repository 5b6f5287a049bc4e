#include "gateway/runtime/exit_watch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <functional>

namespace gateway::runtime {
namespace {

constexpr int kSeen = 7;

/// The exit status of a process forked off to do something.
int status_of(const std::function<void()>& something) {
  const pid_t pid = fork();
  if (pid == 0) {
    something();
    leave(99);
  }
  int status = 0;
  EXPECT_EQ(waitpid(pid, &status, 0), pid);
  EXPECT_TRUE(WIFEXITED(status));
  return WEXITSTATUS(status);
}

/// Where a watch knows the text of the call: kSeen.
void call_watched(const std::string& text, const std::function<void()>& call) {
  const ExitWatch watch([&](const ExitCall& seen) { return seen.text() == text ? kSeen : 98; });
  const hal::node::exchange::ForeignCall step("controller of r0", "step()",
                                              hal::Time{std::chrono::seconds{2}});
  call();
}

TEST(ExitWatch, SeesEveryWayToEndTheProcessAndWhoTookIt) {
  const std::pair<const char*, void (*)(int)> ways[] = {
      {"exit", [](int status) { std::exit(status); }},
      {"_exit", [](int status) { ::_exit(status); }},
      {"_Exit", [](int status) { std::_Exit(status); }},
      {"quick_exit", [](int status) { std::quick_exit(status); }}};
  for (const auto& [name, way] : ways) {
    const std::string text =
        "controller of r0 called " + std::string(name) + "(3) in step() at 2.000000000 s";
    EXPECT_EQ(status_of([&, end = way] { call_watched(text, [&] { end(3); }); }), kSeen) << name;
  }
}

TEST(ExitWatch, LeavesAChildThatIsForkedOffAlone) {
  EXPECT_EQ(status_of([] { call_watched("", [] { leave(status_of([] { ::_exit(5); })); }); }), 5);
}

TEST(ExitWatch, IsOverWithItsLife) {
  EXPECT_EQ(status_of([] {
              call_watched("", [] {});
              ::_exit(6);
            }),
            6);
}

}  // namespace
}  // namespace gateway::runtime
