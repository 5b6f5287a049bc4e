#include "sim/agents/agent_set.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "hal/types/random.h"

namespace sim::agents {
namespace {

using hal::AgentId;

std::vector<std::uint16_t> taken(AgentSet& set) {
  std::vector<std::uint16_t> agents;
  set.take([&agents](AgentId agent) { agents.push_back(agent.value); });
  return agents;
}

TEST(AgentSet, GivesEachAgentOnceInOrderOfAddresses) {
  AgentSet set;
  const std::vector<std::uint16_t> agents{700, 3, 64, 63, 3, 65'535, 700};
  for (const std::uint16_t agent : agents) set.insert(AgentId{agent});
  EXPECT_EQ(taken(set), (std::vector<std::uint16_t>{3, 63, 64, 700, 65'535}));
}

TEST(AgentSet, IsEmptyBeforeTheFirstAndAfterItWasTaken) {
  AgentSet set;
  EXPECT_TRUE(taken(set).empty());
  set.insert(AgentId{1});
  EXPECT_EQ(taken(set).size(), 1u);
  EXPECT_TRUE(taken(set).empty());
  set.insert(AgentId{130});
  EXPECT_EQ(taken(set), (std::vector<std::uint16_t>{130}));
}

TEST(AgentSet, LosesTheErasedOnes) {
  AgentSet set;
  set.insert(AgentId{5});
  set.insert(AgentId{6});
  set.erase(AgentId{5});
  set.erase(AgentId{5});
  set.erase(AgentId{40'000});  // was never in it
  EXPECT_EQ(taken(set), (std::vector<std::uint16_t>{6}));
}

TEST(AgentSet, EqualsASortedSetForRandomAgents) {
  hal::RandomStream random(1, "agents");
  AgentSet set;
  for (int round = 0; round < 50; ++round) {
    std::set<std::uint16_t> expected;
    for (int i = 0; i < 40; ++i) {
      const auto agent = static_cast<std::uint16_t>(1 + 1000 * random.uniform());
      expected.insert(agent);
      set.insert(AgentId{agent});
    }
    EXPECT_EQ(taken(set), std::vector<std::uint16_t>(expected.begin(), expected.end()));
  }
}

}  // namespace
}  // namespace sim::agents
