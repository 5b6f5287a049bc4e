#include "baraka/run/network/programs_of_run.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>

#include "tests/support/printers.h"

namespace baraka::run::network {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using sim::scenario::OnExit;
using sim::scenario::Program;

constexpr int kExit3 = 3 << 8, kKilled = 9;  // as of waitpid()

class ProgramsTest : public testing::Test {
 protected:
  ProgramsTest() {
    for (const AgentId id : {AgentId{1}, AgentId{2}}) {
      sim::agents::AgentConfig agent;
      agent.id = id;
      agent.name = "a" + std::to_string(id.value);
      agent.network.emplace();
      scenario.simulation.agents.push_back(agent);
    }
    sim::scenario::Group group;
    group.name = "group";
    group.agents = {AgentId{1}, AgentId{2}};
    scenario.groups.push_back(group);
  }
  void add(const std::string& name, hal::Duration start, OnExit on_exit) {
    Program program;
    program.name = name;
    program.command = {name};
    program.start = start;
    program.log = "{agent}.log";
    program.on_exit = on_exit;
    program.place = "x.yaml:1:2";
    scenario.groups.front().programs.push_back(program);
  }
  ProgramsOfRun programs() {
    return {sim::scenario::plan_programs(scenario),
            [this](const ProgramsOfRun::Start& start) {
              if (start.program.program->name == "missing")
                throw std::runtime_error("is not there");
              started.push_back(start.program.program->name + " of " + start.program.agent_name);
              return static_cast<std::uint32_t>(started.size());
            },
            [this](std::vector<std::uint8_t> end) { ends.emplace_back(end.begin(), end.end()); }};
  }

  sim::scenario::Scenario scenario;
  std::vector<std::string> started, ends;
};

void start_due(ProgramsOfRun& all, Time now) {
  while (all.next() && *all.next() <= now) all.start_next(now, {});
}

TEST_F(ProgramsTest, StartWhenTheyAreDueInEachAgent) {
  add("late", 2s, OnExit::kIgnore);
  add("early", 1s, OnExit::kIgnore);
  ProgramsOfRun all = programs();
  EXPECT_EQ(all.next(), Time{1s});
  all.start_next(Time{999ms}, {});
  EXPECT_TRUE(started.empty());
  all.start_next(Time{1s}, {});
  EXPECT_EQ(started, (std::vector<std::string>{"early of a1"})) << "others after the frames of now";
  start_due(all, Time{1s});
  EXPECT_EQ(started, (std::vector<std::string>{"early of a1", "early of a2"}));
  EXPECT_EQ(all.next(), Time{2s});
  start_due(all, Time{5s});
  EXPECT_EQ(started.size(), 4u);
  EXPECT_EQ(all.next(), std::nullopt);
}

TEST_F(ProgramsTest, EndTheRunAsTheScenarioSays) {
  add("ignored", 0s, OnExit::kIgnore);
  add("needed", 0s, OnExit::kFail);
  add("judge", 0s, OnExit::kEnd);
  ProgramsOfRun all = programs();
  start_due(all, Time{});
  ASSERT_EQ(started.size(), 6u);  // of a1: 1, 3, 5
  all.on_end(Time{1s}, AgentId{1}, 1, kExit3);
  all.on_end(Time{1s}, AgentId{1}, 3, 0);
  EXPECT_TRUE(ends.empty());
  all.on_end(Time{1s}, AgentId{2}, 4, kKilled);
  all.on_end(Time{2s}, AgentId{2}, 6, kExit3);
  all.on_end(Time{2s}, AgentId{1}, 5, 0);
  all.on_end(Time{2s}, AgentId{1}, 77, 0);  // of somebody else
  EXPECT_EQ(ends, (std::vector<std::string>{"fprogram needed of a2 killed by signal 9; see a2.log",
                                            "fprogram judge of a2 exited with status 3; see a2.log",
                                            "ejudge"}));
  const auto rows = all.rows();
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_EQ(rows[0].status, 3);
  EXPECT_EQ(rows[3].status, 137);
  EXPECT_EQ(rows[3].ended, Time{1s});
  EXPECT_EQ(rows[1].ended, std::nullopt) << "it still runs";
}

TEST_F(ProgramsTest, OneThatCannotBeStartedIsNamedWithItsPlace) {
  add("missing", 0s, OnExit::kIgnore);
  ProgramsOfRun all = programs();
  try {
    start_due(all, Time{});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "x.yaml:1:2: programs: 'missing' of a1: is not there");
  }
}

}  // namespace
}  // namespace baraka::run::network
