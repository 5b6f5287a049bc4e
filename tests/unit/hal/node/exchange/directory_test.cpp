#include "hal/node/exchange/directory.h"

#include <gtest/gtest.h>

#include <string>

namespace hal::node::exchange {
namespace {

TEST(Directory, FindsEveryAgentByNameAndByAddress) {
  constexpr std::uint16_t kAgents = 300;
  std::vector<AgentName> agents;
  for (std::uint16_t i = kAgents; i >= 1; --i) {
    agents.push_back({AgentId{i}, "m" + std::to_string(i)});
  }
  const Directory directory(agents);
  for (const AgentName& one : agents) {
    EXPECT_EQ(directory.address_of(one.name), one.agent);
    EXPECT_EQ(directory.name_of(one.agent), one.name);
  }
}

TEST(Directory, KnowsNobodyElse) {
  const Directory directory({{AgentId{2}, "m2"}, {AgentId{4}, "m4"}});
  for (const char* name : {"", "m", "m1", "m3", "m22", "n", "M2"}) {
    EXPECT_EQ(directory.address_of(name), std::nullopt) << name;
  }
  for (const AgentId agent : {AgentId{}, AgentId{1}, AgentId{3}, AgentId{5}, kEveryone}) {
    EXPECT_EQ(directory.name_of(agent), std::nullopt) << agent.value;
  }
  EXPECT_EQ(Directory().address_of("m2"), std::nullopt);
  EXPECT_EQ(Directory().name_of(AgentId{2}), std::nullopt);
}

}  // namespace
}  // namespace hal::node::exchange
