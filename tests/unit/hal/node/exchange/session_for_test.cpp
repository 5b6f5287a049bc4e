#include <gtest/gtest.h>

#include "hal/node/exchange/ports.h"

namespace {

using hal::node::exchange::AgentOffer;
using hal::node::exchange::AgentSession;

AgentOffer offer_with(const std::vector<std::string>& channels) {
  AgentOffer offer;
  offer.session.agent = hal::AgentId{7};
  offer.session.name = "r0";
  offer.session.kind = hal::AgentKind::kRobot;
  offer.session.seed = 3;
  offer.session.parameters = {{.name = "speed", .value = "1 m/s", .place = "a.yaml:1:2"}};
  std::uint16_t id = 0;
  for (const std::string& name : channels) {
    hal::Channel channel;
    channel.id = id++;
    channel.name = name;
    offer.session.channels.push_back(channel);
  }
  return offer;
}

TEST(SessionFor, KeepsOnlyTheChannelsAskedForInTheOrderOfTheOffer) {
  const AgentOffer offer = offer_with({"infrared", "odometry", "localisation"});
  const auto session = session_for(offer, {.channels = {"localisation", "infrared"}});
  ASSERT_TRUE(session.has_value());
  ASSERT_EQ(session->channels.size(), 2U);
  EXPECT_EQ(session->channels[0].name, "infrared");
  EXPECT_EQ(session->channels[1].name, "localisation");
  EXPECT_EQ(session->channels[1].id, 2) << "ids are the agent's, not renumbered";
}

TEST(SessionFor, LeavesEverythingElseOfTheOfferAsItIs) {
  const AgentOffer offer = offer_with({"infrared"});
  const auto session = session_for(offer, {.channels = {"infrared"}});
  ASSERT_TRUE(session.has_value());
  EXPECT_EQ(*session, offer.session);
}

TEST(SessionFor, GivesNoChannelsToAControllerThatAskedForNone) {
  const auto session = session_for(offer_with({"infrared"}), {});
  ASSERT_TRUE(session.has_value());
  EXPECT_TRUE(session->channels.empty());
}

TEST(SessionFor, GivesOptionalChannelsWhereTheyAreAndDoesWithoutThemElsewhere) {
  const hal::Wants wants{.channels = {"odometry"}, .optional = {"infrared", "battery"}};
  const auto sees = session_for(offer_with({"infrared", "odometry", "localisation"}), wants);
  ASSERT_TRUE(sees.has_value());
  ASSERT_EQ(sees->channels.size(), 2U);
  EXPECT_EQ(sees->channels[0].name, "infrared");
  EXPECT_EQ(sees->channels[1].name, "odometry");
  const auto blind = session_for(offer_with({"odometry", "localisation"}), wants);
  ASSERT_TRUE(blind.has_value());
  ASSERT_EQ(blind->channels.size(), 1U);
  EXPECT_EQ(blind->channels[0].name, "odometry");
  EXPECT_FALSE(session_for(offer_with({"infrared"}), wants).has_value());
}

TEST(SessionFor, NamesAChannelThatDoesNotExistAndThoseThatDo) {
  const auto session = session_for(offer_with({"infrared", "odometry"}), {.channels = {"lidar"}});
  ASSERT_FALSE(session.has_value());
  EXPECT_EQ(session.error().code, hal::Errc::kNotAvailable);
  EXPECT_EQ(session.error().message, "r0 has no channel 'lidar'; it has: infrared, odometry");
}

TEST(SessionFor, SaysSoWhenTheAgentHasNoChannelsAtAll) {
  const auto session = session_for(offer_with({}), {.channels = {"infrared"}});
  ASSERT_FALSE(session.has_value());
  EXPECT_EQ(session.error().message, "r0 has no channel 'infrared'; it has: none");
}

}  // namespace
