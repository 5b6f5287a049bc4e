#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "baraka/run/controllers/controllers_of_run.h"
#include "gateway/process/exit_status.h"
#include "sim/agents/fingerprint_feed.h"
#include "sim/scenario/scenario.h"
#include "tests/support/no_pace.h"
#include "tests/support/test_domain.h"

namespace baraka::run::controllers {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

const fs::path kCaseStudy = fs::path(CONFIG_DIR) / "scenarios/case_study.yaml";

/// Starts controllers in user, network and pid namespaces of their own, where there is a loopback
/// interface and nothing else.
class Unshared final : public gateway::server::InsideStarter {
 public:
  static bool is_possible() {
    return std::system("unshare -Urn --pid --fork true 2> /dev/null") == 0;  // NOLINT: of a test
  }

  ~Unshared() override {
    for (const pid_t pid : started_) {
      kill(pid, SIGKILL);
      waitpid(pid, nullptr, 0);
    }
  }

  void start(hal::AgentId, const gateway::server::InsideProgram& program) override {
    std::vector<std::string> words{"unshare", "-Urn", "--pid", "--fork", "--kill-child=SIGKILL",
                                   "env"};
    for (const auto& [name, value] : program.environment) words.push_back(name + "=" + value);
    words.insert(words.end(), program.arguments.begin(), program.arguments.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t pid = fork();
    if (pid == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      for (const int one : program.inherited) fcntl(one, F_SETFD, 0);
      execvp(arguments[0], arguments.data());
      _exit(127);
    }
    started_.push_back(pid);
  }
  hal::Result<void> check() override { return {}; }

  std::size_t started() const { return started_.size(); }

 private:
  std::vector<pid_t> started_;
};

/// The case study; with its robots' controllers inside, though in lock-step, which programs on the
/// air are not: so that its fingerprint can be compared.
sim::scenario::Scenario case_study(bool inside) {
  std::vector<std::string> overrides{"agents.robots.network={}"};
  if (inside) overrides.emplace_back("agents.robots.controller.inside=true");
  return sim::scenario::load_scenario(kCaseStudy, overrides);
}

/// What a run came to, and what was recorded of its controllers inside.
struct Played {
  std::uint64_t fingerprint = 0;
  std::vector<sim::OutsideArrival> replies;
};

class Arrivals final : public sim::agents::Observer {
 public:
  void on_arrival(const sim::OutsideArrival& arrival) override { all.push_back(arrival); }
  std::vector<sim::OutsideArrival> all;
};

Played play(const sim::scenario::Scenario& scenario, const ControllersOfRun::Settings& settings) {
  Arrivals arrivals;
  sim::agents::Simulation simulation(scenario.simulation, {&arrivals});
  sim::agents::FingerprintFeed fingerprint;
  simulation.add_observer(fingerprint);
  ControllersOfRun controllers(scenario, simulation, settings);
  tests::NoPace pace;
  const auto outcome = simulation.run(hal::Time{20s}, pace);
  EXPECT_EQ(outcome.error, "");
  controllers.finish(true, {});
  fingerprint.finish();
  return {fingerprint.fingerprint().total(), take_replies(arrivals.all)};
}

TEST(InsideControllers, GiveTheFingerprintOfThoseInProcessAndItsRecordToo) {
  if (!Unshared::is_possible()) GTEST_SKIP() << "no namespaces can be made here";
  // With the sanitizers only tests are built.
  if (!fs::exists(fs::path(BIN_DIR) / "help_mote")) GTEST_SKIP() << "no controllers here";
  setenv("BARAKA_CONTROLLER_PATH", BIN_DIR, 1);
  const fs::path logs = fs::path(testing::TempDir()) / ("inside_" + std::to_string(getpid()));
  fs::create_directory(logs);
  const Played in_process = play(case_study(false), {.from = ControllersFrom::kInProcess});
  EXPECT_TRUE(in_process.replies.empty());

  Unshared unshared;
  const auto inside = case_study(true);
  const Played played = play(inside, {.domain = test_domain(), .logs = logs, .inside = &unshared});
  EXPECT_GT(unshared.started(), 0U);
  EXPECT_EQ(played.fingerprint, in_process.fingerprint);
  EXPECT_FALSE(played.replies.empty());

  const Played repeated =
      play(inside, {.from = ControllersFrom::kInProcess, .logs = logs, .replies = &played.replies});
  EXPECT_EQ(repeated.fingerprint, in_process.fingerprint);
  EXPECT_TRUE(repeated.replies == played.replies);
  fs::remove_all(logs);
}

TEST(InsideControllers, AreProcessesThatTheRunStarts) {
  const auto scenario = case_study(true);
  sim::agents::Simulation simulation(scenario.simulation, {});
  setenv("BARAKA_CONTROLLER_PATH", BIN_DIR, 1);
  for (const auto& [from, text] : {std::pair{ControllersFrom::kInProcess, "in-process"},
                                   std::pair{ControllersFrom::kExternal, "external"}}) {
    try {
      ControllersOfRun(scenario, simulation, {.from = from});
      ADD_FAILURE() << text;
    } catch (const gateway::process::UsageError& error) {
      EXPECT_EQ(std::string(error.what()),
                std::string("--controllers ") + text +
                    ": 'robots' is inside its agent's network, and so a process that the run "
                    "starts");
    }
  }
}

}  // namespace
}  // namespace baraka::run::controllers
