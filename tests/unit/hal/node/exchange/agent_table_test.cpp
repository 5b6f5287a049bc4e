#include "hal/node/exchange/agent_table.h"

#include <gtest/gtest.h>

#include <map>

#include "hal/types/random.h"

namespace hal::node::exchange {
namespace {

TEST(AgentTable, HoldsWhatAMapHoldsInTheSameOrder) {
  AgentTable<int> table;
  std::map<AgentId, int> expected;
  RandomStream random(1, "agents");
  for (int i = 0; i < 300; ++i) {
    const AgentId agent{static_cast<std::uint16_t>(random.below(500))};
    table[agent] += i;
    expected[agent] += i;
  }
  EXPECT_EQ(table.size(), expected.size());
  auto entry = table.begin();
  for (const auto& [agent, value] : expected) {
    EXPECT_EQ(entry->first, agent);
    EXPECT_EQ(entry++->second, value);
    EXPECT_EQ(table.at(agent), value);
  }
  for (std::uint16_t address = 0; address < 600; ++address) {
    EXPECT_EQ(table.contains(AgentId{address}), expected.contains(AgentId{address}));
  }
}

TEST(AgentTable, HasNothingAtAnAddressThatWasNotAdded) {
  AgentTable<int> table;
  EXPECT_EQ(table.find(AgentId{3}), nullptr);
  table[AgentId{5}] = 1;
  EXPECT_EQ(table.find(AgentId{3}), nullptr);
  EXPECT_EQ(table.find(AgentId{0xfffe}), nullptr);
  EXPECT_EQ(*table.find(AgentId{5}), 1);
}

}  // namespace
}  // namespace hal::node::exchange
