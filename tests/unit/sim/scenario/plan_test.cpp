#include "sim/scenario/plan.h"

#include <gtest/gtest.h>

namespace sim::scenario {
namespace {

Group group(const std::string& name, int first, int count, int processes) {
  Group made{.name = name, .agents = {}, .program = name + "_program", .program_place = "f:1:1"};
  made.processes = processes;
  for (int i = 0; i < count; ++i) {
    made.agents.push_back(hal::AgentId{static_cast<std::uint16_t>(first + i)});
  }
  return made;
}

std::vector<std::size_t> shares(const std::vector<ProcessPlan>& plans) {
  std::vector<std::size_t> sizes;
  for (const ProcessPlan& plan : plans) sizes.push_back(plan.agents.size());
  return sizes;
}

TEST(PlanProcesses, GivesAGroupOneProcessOfItsName) {
  Scenario scenario;
  scenario.groups = {group("motes", 1, 25, 1), group("robots", 26, 1, 1)};
  const auto plans = plan_processes(scenario);
  ASSERT_EQ(plans.size(), 2u);
  EXPECT_EQ(plans[0].process, "motes");
  EXPECT_EQ(plans[0].program, "motes_program");
  EXPECT_EQ(plans[1].process, "robots");
  EXPECT_EQ(plans[1].agents, std::vector{hal::AgentId{26}});
}

TEST(PlanProcesses, SpreadsAgentsEvenlyAndInOrder) {
  Scenario scenario;
  scenario.groups = {group("motes", 1, 25, 4)};
  const auto plans = plan_processes(scenario);
  EXPECT_EQ(shares(plans), (std::vector<std::size_t>{7, 6, 6, 6}));
  EXPECT_EQ(plans[0].process, "motes-1");
  EXPECT_EQ(plans[3].process, "motes-4");
  std::uint16_t next = 1;
  for (const ProcessPlan& plan : plans) {
    for (const hal::AgentId id : plan.agents) EXPECT_EQ(id.value, next++);
  }
  EXPECT_EQ(next, 26);
}

TEST(PlanProcesses, MayGiveEveryAgentAProcess) {
  Scenario scenario;
  scenario.groups = {group("motes", 1, 25, 25)};
  EXPECT_EQ(shares(plan_processes(scenario)), std::vector<std::size_t>(25, 1));
}

}  // namespace
}  // namespace sim::scenario
