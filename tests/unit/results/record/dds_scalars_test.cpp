#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "results/record/scalars.h"
#include "results/record/topic_name.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

/// Topics whose names would be equal without what is escaped; the last is read by two agents, one
/// of which is told of twice; nobody reads "quiet".
constexpr const char* kTopics =
    "INSERT INTO run VALUES ('simulated_s', 10.0);"
    "INSERT INTO agents VALUES (1, 'a', 'station', '', 0, 0, 0), (2, 'b', 'station', '', 0, 0, 0),"
    " (3, 'c', 'station', '', 0, 0, 0);"
    "INSERT INTO countable VALUES ('dds.lost', '', 'queue full'), ('air', '', '802.11');"
    "INSERT INTO dds_endpoints VALUES"
    " ('w1', 1, 'writer', 'a.b', 't', 'reliable', 'volatile', 0),"
    " ('w2', 1, 'writer', 'a_b', 't', 'reliable', 'volatile', 0),"
    " ('w3', 1, 'writer', 'A_b', 't', 'reliable', 'volatile', 0),"
    " ('w4', 1, 'writer', 'a%2Eb', 't', 'reliable', 'volatile', 0),"
    " ('w5', 1, 'writer', 'rt/r0/scan', 't', 'reliable', 'volatile', 0),"
    " ('w6', 1, 'writer', 'quiet', 't', 'reliable', 'volatile', 0),"
    " ('r1', 2, 'reader', 'rt/r0/scan', 't', 'reliable', 'volatile', 0),"
    " ('r2', 3, 'reader', 'rt/r0/scan', 't', 'reliable', 'volatile', 0),"
    " ('r3', 3, 'reader', 'rt/r0/scan', 't', 'reliable', 'volatile', 0);"
    "INSERT INTO sample_sums VALUES ('w1', 2, 1, 1, 1, 0, 0, 1, 9, 1), ('w2', 2, 2, 2, 2, 0, 0, 1,"
    " 9, 1), ('w3', 2, 3, 3, 3, 0, 0, 1, 9, 1), ('w4', 2, 4, 4, 4, 0, 0, 1, 9, 1),"
    " ('w5', 2, 10, 8, 6, 1, 5, 10, 900, 8000000), ('w5', 3, 10, 4, 4, 0, 7, 10, 900, 40000000);"
    "INSERT INTO sample_losses VALUES ('w5', 2, 'collision', 1, 1), ('w5', 3, 'collision', 2, 6);"
    "INSERT INTO sample_latencies VALUES ('w5', 2, 1000000, 6), ('w5', 2, 2000000, 2),"
    " ('w5', 3, 8000000, 4);"
    "INSERT INTO air_accounts VALUES (1, 1, 'user', 'DATA', NULL, 'rt/r0/scan', 9, 0, 9, 0, 99,"
    " 30000000), (2, 2, 'user', 'ACKNACK', NULL, 'rt/r0/scan', 9, 0, 9, 0, 99, 10000000),"
    " (3, 1, '802.11', 'ack', NULL, NULL, 9, 0, 9, 0, 99, 5000000);";

class ScalarsOfTopics : public testing::Test {
 protected:
  ScalarsOfTopics() : folder_(testing::UnitTest::GetInstance()->current_test_info()->name()) {
    make_result(folder_.path(), kTopics);
    RunReader reader(folder_.path());
    all = scalars_of(reader);
  }

  std::optional<double> value(const std::string& name, const std::string& agent = "") const {
    const auto found = std::ranges::find_if(
        all, [&](const Scalar& one) { return one.name == name && one.agent == agent; });
    return found == all.end() ? std::nullopt : std::optional(found->value);
  }

  std::vector<Scalar> all;

 private:
  Folder folder_;
};

TEST_F(ScalarsOfTopics, DifferentTopicsHaveDifferentNames) {
  EXPECT_EQ(value("dds.a%2Eb.samples"), 1);
  EXPECT_EQ(value("dds.a_b.samples"), 2);
  EXPECT_EQ(value("dds.A_b.samples"), 3);
  EXPECT_EQ(value("dds.a%252Eb.samples"), 4);
  std::set<std::pair<std::string, std::string>> names;
  for (const Scalar& one : all)
    EXPECT_TRUE(names.emplace(one.name, one.agent).second) << one.name << " of " << one.agent;
}

TEST_F(ScalarsOfTopics, AreSumsOfWritersByReadingAgentAndInTotal) {
  EXPECT_EQ(value("dds.rt/r0/scan.samples"), 20);
  EXPECT_EQ(value("dds.rt/r0/scan.samples", "b"), 10);
  EXPECT_EQ(value("dds.rt/r0/scan.samples", "a"), std::nullopt);
  EXPECT_EQ(value("dds.rt/r0/scan.delivered_share"), 0.6);
  EXPECT_EQ(value("dds.rt/r0/scan.delivered_share", "c"), 0.4);
  EXPECT_EQ(value("dds.rt/r0/scan.first_try_share", "b"), 0.6);
  EXPECT_EQ(value("dds.rt/r0/scan.repaired"), 2);
  EXPECT_EQ(value("dds.rt/r0/scan.repairs", "c"), 7);
  EXPECT_EQ(value("dds.rt/r0/scan.under_way"), 1);
  EXPECT_EQ(value("dds.rt/r0/scan.lost.collision"), 7);
  EXPECT_EQ(value("dds.rt/r0/scan.lost.queue_full"), 0);
  EXPECT_EQ(value("dds.samples"), 30);
}

// The 6th of 12 is in the first bin, the 12th in the last; ranks are rounded up.
TEST_F(ScalarsOfTopics, QuantilesAreMiddlesOfBins) {
  constexpr double kMiddle = 1 + 1.0 / 64;
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.latency.p50"), 1e-3 * kMiddle);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.latency.p95"), 8e-3 * kMiddle);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.latency.p50", "b"), 1e-3 * kMiddle);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.latency.p99", "b"), 2e-3 * kMiddle);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.latency.mean"), 4e-3);
}

TEST_F(ScalarsOfTopics, WhatWasAnnouncedHasZerosAndNoShares) {
  EXPECT_EQ(value("dds.quiet.samples"), 0);
  EXPECT_EQ(value("dds.quiet.airtime", "a"), 0);
  EXPECT_EQ(value("dds.quiet.lost.collision"), 0);
  EXPECT_EQ(value("dds.quiet.delivered_share"), std::nullopt);
  EXPECT_EQ(value("dds.quiet.latency.mean"), std::nullopt);
  EXPECT_EQ(value("dds.quiet.latency.p50"), std::nullopt);
}

TEST_F(ScalarsOfTopics, AirTimeIsByTransmitterAndOverTheTime) {
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.airtime"), 0.04);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.airtime", "b"), 0.01);
  EXPECT_DOUBLE_EQ(*value("dds.rt/r0/scan.air_share", "a"), 0.003);
  EXPECT_EQ(value("dds.rt/r0/scan.airtime", "c"), 0) << "it reads";
  EXPECT_DOUBLE_EQ(*value("air.user.airtime"), 0.04);
  EXPECT_DOUBLE_EQ(*value("air.802_11.air_share"), 0.0005);
}

TEST(TopicName, IsEscapedAndReadBack) {
  for (const char* topic : {"rt/r0/scan", "a.b", "a%2Eb", "a b", "caf\xc3\xa9", "%", "a%", "%2"})
    EXPECT_EQ(topic_of_part(topic_part(topic)), topic);
  EXPECT_EQ(topic_part("rt/r0/scan"), "rt/r0/scan");
  EXPECT_EQ(topic_part("a.b c"), "a%2Eb%20c");
}

}  // namespace
}  // namespace results::record::test
