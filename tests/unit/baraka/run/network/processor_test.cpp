#include "baraka/run/network/processor.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

namespace baraka::run::network {
namespace {

cpu_set_t allowed() {
  cpu_set_t set{};
  sched_getaffinity(0, sizeof set, &set);
  return set;
}

/// Of a process that begins now.
int processors_of_child() {
  const pid_t child = fork();
  if (child == 0) {
    const cpu_set_t set = allowed();
    _exit(CPU_COUNT(&set));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

TEST(Processor, IsTheOnlyOneWhileItIsUsed) {
  const cpu_set_t before = allowed();
  const Processor processor;
  {
    const Processor::Use use(processor);
    EXPECT_EQ(processors_of_child(), 1);
  }
  const cpu_set_t after = allowed();
  EXPECT_TRUE(CPU_EQUAL(&before, &after));
}

TEST(Processor, IsAnotherForASecondRunWhileThereIsOne) {
  const cpu_set_t all = allowed();
  if (CPU_COUNT(&all) < 2) GTEST_SKIP() << "there is one processor";
  const auto used_by = [](const Processor& processor) {
    const Processor::Use use(processor);
    return allowed();
  };
  const Processor first;
  const cpu_set_t of_first = used_by(first);
  {
    const Processor second;
    const cpu_set_t of_second = used_by(second);
    // Unless runs of others have taken the rest.
    if (second.is_shared()) GTEST_SKIP() << "other runs use the processors";
    EXPECT_FALSE(CPU_EQUAL(&of_first, &of_second));
  }
  EXPECT_EQ(CPU_COUNT(&of_first), 1);
}

TEST(Processor, IsOneOfThoseAllowed) {
  const cpu_set_t before = allowed();
  int last = 0;
  for (int i = 0; i < CPU_SETSIZE; ++i) last = CPU_ISSET(i, &before) ? i : last;
  cpu_set_t one{};
  CPU_SET(last, &one);
  sched_setaffinity(0, sizeof one, &one);
  {
    const Processor processor;
    const Processor::Use use(processor);
    const cpu_set_t now = allowed();
    EXPECT_TRUE(CPU_EQUAL(&now, &one));
  }
  sched_setaffinity(0, sizeof before, &before);
}

}  // namespace
}  // namespace baraka::run::network
