#include "gateway/process/spawn.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "gateway/process/find_program.h"
#include "tests/support/fake_clock.h"

namespace gateway::process {
namespace {

constexpr hal::Duration kPatience = std::chrono::seconds{30};

/// A folder of its own for every test.
class Spawning : public testing::Test {
 protected:
  Spawning() {
    char name[] = "/tmp/baraka-spawn-XXXXXX";
    folder_ = mkdtemp(name);
  }
  ~Spawning() override { std::filesystem::remove_all(folder_); }

  Command shell(const std::string& script) const {
    return {.program = "/bin/sh", .arguments = {"-c", script}, .domain = 42, .log = log()};
  }
  std::filesystem::path log() const { return folder_ / "log"; }
  std::string logged() const {
    std::ostringstream text;
    text << std::ifstream(log()).rdbuf();
    return text.str();
  }

  std::filesystem::path folder_;
  Spawner spawner_;
};

TEST_F(Spawning, GivesTheDomainAndKeepsTheOutput) {
  spawner_.start(shell("echo domain $BARAKA_DOMAIN; echo trouble >&2"));
  spawner_.wait_all(kPatience);
  EXPECT_EQ(logged(), "domain 42\ntrouble\n");
}

TEST_F(Spawning, TellsHowEachEnded) {
  const pid_t failed = spawner_.start(shell("exit 3"));
  const pid_t killed = spawner_.start(shell("kill -9 $$"));
  spawner_.wait_all(kPatience);
  const auto checked = spawner_.check();
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().message,
            "sh (pid " + std::to_string(failed) + ") exited with status 3; see " + log().string());
  const auto endings = spawner_.stop_all();
  ASSERT_EQ(endings.size(), 2);
  EXPECT_EQ(endings[0].status, 3);
  EXPECT_EQ(endings[1].pid, killed);
  EXPECT_EQ(endings[1].status, 128 + 9);
  EXPECT_EQ(endings[1].cause, "killed by signal 9");
}

TEST_F(Spawning, RepeatsTheLastWordsOfAProgramThatEnded) {
  spawner_.start(shell("echo hello; echo no such robot >&2; exit 1"));
  spawner_.wait_all(kPatience);
  const auto checked = spawner_.check();
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.error().message.find("exited with status 1: no such robot; see "),
            std::string::npos)
      << checked.error().message;
}

TEST_F(Spawning, StopsWithSigtermFirst) {
  spawner_.start(shell("trap 'exit 5' TERM; echo ready; while :; do sleep 0.01; done"));
  while (logged() != "ready\n") usleep(1000);  // Before, the shell has no trap yet.
  EXPECT_TRUE(spawner_.check());
  const auto endings = spawner_.stop_all();
  EXPECT_EQ(endings.at(0).status, 5);
}

TEST_F(Spawning, KillsWhatIgnoresSigterm) {
  tests::FakeClock clock;
  Spawner spawner(clock);
  spawner.start(shell("trap '' TERM; echo ready; while :; do sleep 0.01; done"));
  while (logged() != "ready\n") usleep(1000);
  EXPECT_EQ(spawner.stop_all().at(0).cause, "killed by signal 9");
  EXPECT_EQ(clock.now(), hal::Time{std::chrono::seconds{2}}) << "so long it is left";
}

TEST_F(Spawning, ProcessesHaveTheirOwnGroupAndDieWithTheSpawner) {
  pid_t pid = 0;
  {
    Spawner spawner;
    pid = spawner.start(shell("sleep 100"));
    EXPECT_EQ(getpgid(pid), pid);
  }
  EXPECT_EQ(kill(pid, 0), -1);
}

TEST_F(Spawning, ProcessesDieWhenTheirParentIsKilled) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    Spawner spawner;
    const pid_t grandchild = spawner.start(shell("sleep 100"));
    [[maybe_unused]] const auto written = write(pipe_ends[1], &grandchild, sizeof grandchild);
    while (true) pause();
  }
  pid_t grandchild = 0;
  ASSERT_EQ(read(pipe_ends[0], &grandchild, sizeof grandchild), ssize_t{sizeof grandchild});
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  // It is init's child now; init, or nobody, reaps it: a zombie counts as dead.
  for (int tries = 0; tries < 5000; ++tries) {
    std::ifstream status("/proc/" + std::to_string(grandchild) + "/stat");
    std::string text;
    if (!std::getline(status, text) || text.find(") Z ") != std::string::npos) return;
    usleep(1000);
  }
  FAIL() << "process " << grandchild << " has outlived its parent by 5 s";
}

TEST_F(Spawning, MissingProgramIsAnError) {
  EXPECT_THROW(spawner_.start({.program = "/no/such/program", .arguments = {}, .log = log()}),
               std::runtime_error);
}

TEST_F(Spawning, ProgramsAreFoundInOrderOfTheFolders) {
  const auto first = folder_ / "a", second = folder_ / "b";
  std::filesystem::create_directory(first);
  std::filesystem::create_directory(second);
  std::ofstream(first / "no_program") << "text";  // Not executable.
  for (const auto& path : {first / "both", second / "both", second / "no_program"}) {
    std::ofstream(path) << "#!/bin/sh\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  EXPECT_EQ(find_program("both", {first, second}), first / "both");
  EXPECT_EQ(find_program("no_program", {first, second}), second / "no_program");
  EXPECT_EQ(find_program("none", {first, second}), std::nullopt);
}

}  // namespace
}  // namespace gateway::process
