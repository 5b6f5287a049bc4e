#include "programs/topics/plan.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace programs::topics {
namespace {

using namespace std::chrono_literals;
using Qos = hal::TopicQos;

Plan full_plan() {
  Plan plan{.name = "r0",
            .domain = 7,
            .seed = 0xfedcba9876543210u,  // above 2^63
            .begin = 1500ms,
            .journal = "/tmp/x/r0.topics.json",
            .writes = {},
            .reads = {}};
  const Qos best_effort{Qos::Reliability::kBestEffort, Qos::Durability::kVolatile, 5, 200ms};
  const Qos all{Qos::Reliability::kReliable, Qos::Durability::kTransientLocal, std::nullopt, {}};
  plan.writes = {
      {"a", best_effort, SizeCycle{{8000, 9}}, Periodic{12.5, 3ms}},
      {"b", all, UniformSizes{8, 4'000'000'000u}, Poisson{0.1}},
      {"c", all, SizeCycle{{64}}, Bursts{2, 20, 1ms}},
      {"d", all, {}, Recorded{{{0ns, 8}, {7ns, 100}}, 920ms, 10ms}, 3},
  };
  plan.reads = {{"e", best_effort}, {"f", all, 2}};
  return plan;
}

TEST(Plan, IsTheSameAfterBeingWrittenAndRead) {
  const std::string text = json_text(full_plan());
  const Plan read = parsed(text);
  EXPECT_EQ(json_text(read), text);
  EXPECT_EQ(read.name, "r0");
  EXPECT_EQ(read.domain, 7u);
  EXPECT_EQ(read.seed, 0xfedcba9876543210u);
  EXPECT_EQ(read.begin, 1500ms);
  EXPECT_EQ(read.journal, "/tmp/x/r0.topics.json");
  ASSERT_EQ(read.writes.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(read.writes[i].name, full_plan().writes[i].name);
    EXPECT_EQ(read.writes[i].qos, full_plan().writes[i].qos);
  }
  EXPECT_EQ(std::get<SizeCycle>(read.writes[0].sizes).sizes, (std::vector<std::uint32_t>{8000, 9}));
  EXPECT_EQ(std::get<Periodic>(read.writes[0].rhythm).rate, 12.5);
  EXPECT_EQ(std::get<Periodic>(read.writes[0].rhythm).jitter, 3ms);
  EXPECT_EQ(std::get<UniformSizes>(read.writes[1].sizes).to, 4'000'000'000u);
  EXPECT_EQ(std::get<Poisson>(read.writes[1].rhythm).rate, 0.1);
  EXPECT_EQ(std::get<Bursts>(read.writes[2].rhythm).samples, 20u);
  EXPECT_EQ(std::get<Bursts>(read.writes[2].rhythm).spacing, 1ms);
  const auto& recorded = std::get<Recorded>(read.writes[3].rhythm);
  ASSERT_EQ(recorded.samples.size(), 2u);
  EXPECT_EQ(recorded.samples[1].at, 7ns);
  EXPECT_EQ(recorded.samples[1].bytes, 100u);
  EXPECT_EQ(recorded.repeat_after, 920ms);
  EXPECT_EQ(recorded.spread, 10ms);
  EXPECT_EQ(read.writes[3].participant, 3u);
  EXPECT_EQ(read.reads[1].participant, 2u);
  ASSERT_EQ(read.reads.size(), 2u);
  EXPECT_EQ(read.reads[1].qos, full_plan().reads[1].qos);
}

TEST(Plan, HasAPartForEachParticipant) {
  Plan plan = full_plan();
  plan.flows = {{9000, {"10.77.0.3"}, {}}};
  plan.ports = {9001};
  EXPECT_EQ(participants_of(plan), (std::vector<std::uint32_t>{0, 2, 3}));
  const Plan first = part_of(plan, 0), second = part_of(plan, 2), third = part_of(plan, 3);
  EXPECT_EQ(first.writes.size(), 3u);
  EXPECT_EQ(first.reads.size(), 1u);
  EXPECT_EQ(first.flows.size(), 1u);
  EXPECT_EQ(first.ports.size(), 1u);
  EXPECT_TRUE(second.writes.empty() && second.flows.empty() && second.ports.empty());
  EXPECT_EQ(second.reads.at(0).name, "f");
  EXPECT_EQ(third.writes.at(0).name, "d");
  EXPECT_TRUE(third.reads.empty());
  plan.writes.clear();
  plan.reads.clear();
  EXPECT_EQ(participants_of(plan), std::vector<std::uint32_t>{0});  // it has the flows
}

TEST(Plan, RefusesWhatIsNone) {
  EXPECT_THROW(parsed("{"), std::runtime_error);
  EXPECT_THROW(parsed("{\"name\": \"r0\"}"), std::runtime_error);
  EXPECT_THROW(read_plan("/nowhere/plan.json"), std::runtime_error);
}

}  // namespace
}  // namespace programs::topics
