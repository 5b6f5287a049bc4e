#include "programs/topics/journal.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace programs::topics {
namespace {

TEST(Journals, AreJoinedWithTheRowsOfAll) {
  Journal first("r0"), second("r0");
  first.wrote("a", true, 5);
  first.sent(9000, true);
  second.wrote("b", false, 7);
  second.received("c", "r1", 12);
  const auto all = nlohmann::json::parse(joined({first.close(), "", second.close()}));
  EXPECT_EQ(all.at("participant"), "r0");
  ASSERT_EQ(all.at("written").size(), 2u);
  EXPECT_EQ(all["written"][0].at("topic"), "a");
  EXPECT_EQ(all["written"][0].at("samples"), 1);
  EXPECT_EQ(all["written"][1].at("topic"), "b");
  EXPECT_EQ(all["written"][1].at("refused"), 1);
  ASSERT_EQ(all.at("received").size(), 1u);
  EXPECT_EQ(all["received"][0].at("writer"), "r1");
  EXPECT_EQ(all.at("datagrams_sent").size(), 1u);
  EXPECT_TRUE(all.at("datagrams_received").empty());
}

}  // namespace
}  // namespace programs::topics
