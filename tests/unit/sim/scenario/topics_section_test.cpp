#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "hal/files/config/errors.h"
#include "sim/scenario/plan.h"
#include "sim/scenario/resolved.h"
#include "sim/scenario/topic_parts.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;
using Qos = hal::TopicQos;

const std::string kBag = TESTS_DIR "/unit/hal/files/recording/bags/plain.mcap";

/// A base that reads, robots r0 and r1 with the topics of a test, an idle station.
class Topics : public testing::Test {
 protected:
  Topics() { fs::create_directories(folder_); }
  ~Topics() override { fs::remove_all(folder_); }

  /// @param more  further keys of the robots, on one line.
  Scenario loaded(const std::string& topics, const std::string& more = "") const {
    const fs::path file = folder_ / "robots.yaml";
    std::ofstream(file)
        << "version: 1\nradio: {profile: ideal, range: 100 m}\nseed: 9\nagents:\n"
           "  base: {name: base, station: {}, poses: [{x: 0 m, y: 0 m}], network: {}}\n"
           "  idle: {name: idle, station: {}, poses: [{x: 9 m, y: 0 m}], network: {}}\n"
           "  r:\n    station: {}\n    poses: [{x: 1 m, y: 0 m}, {x: 2 m, y: 0 m}]\n"
           "    network: {}\n"
        << (more.empty() ? "" : "    " + more + "\n") << "    topics:\n"
        << topics << "end: [{at: 1 s, result: done}]\n";
    return load_scenario(file, {});
  }

  const TopicItem& item(const Scenario& scenario, std::size_t index) const {
    return scenario.groups.back().topics.at(index);
  }

  fs::path folder_ = fs::temp_directory_path() / ("topics_section." + std::to_string(::getpid()));
};

TEST_F(Topics, AreReadWithTheirDefaults) {
  const Scenario scenario =
      loaded("      - {name: a, size: 8 kB, rate: 12.5 Hz, readers: [base]}\n");
  const TopicItem& a = item(scenario, 0);
  EXPECT_EQ(std::get<std::vector<std::uint32_t>>(a.sizes), std::vector<std::uint32_t>{8000});
  EXPECT_EQ(std::get<PeriodicSamples>(a.rhythm).rate, 12.5);
  EXPECT_EQ(a.qos, Qos{});
  const DdsKeys& dds = scenario.groups.back().dds;
  EXPECT_EQ(dds.vendor, DdsVendor::kCycloneDds);
  EXPECT_EQ(dds.domain, 0u);
  EXPECT_EQ(dds.begin, 1s);
}

TEST_F(Topics, KeepTheirValuesInTheResolvedFile) {
  const Scenario scenario = loaded(
      "      - {name: a, size: [1 kB, 9 B], rate: 10 Hz, jitter: 5 ms, reliability: best_effort,\n"
      "         history: 5, deadline: 200 ms, readers: [base, \"r*\"]}\n"
      "      - {name: b, size: {from: 1 kB, to: 2 MB}, poisson: 3 Hz, history: all,\n"
      "         durability: transient_local, readers: [r1]}\n"
      "      - {name: c, size: 64 B, bursts: {rate: 1 Hz, samples: 20, spacing: 1 ms}, readers: "
      "[base]}\n"
      "      - {from: " +
          kBag +
          ", name: \"*/scan\", rename: {rt/scan: laser}, repeat: true,\n"
          "         reliability: reliable, history: 3, deadline: 1 s, readers: [base]}\n",
      "dds: {vendor: fastdds, domain: 3, start: 200 ms, begin: 2 s}");
  const std::string resolved = resolved_yaml(scenario);
  std::ofstream(folder_ / "again.yaml") << resolved;
  const Scenario again = load_scenario(folder_ / "again.yaml", {});
  EXPECT_EQ(resolved_yaml(again), resolved);
  EXPECT_EQ(std::get<std::vector<std::uint32_t>>(item(again, 0).sizes),
            (std::vector<std::uint32_t>{1000, 9}));
  EXPECT_EQ(std::get<PeriodicSamples>(item(again, 0).rhythm).jitter, 5ms);
  EXPECT_EQ(item(again, 0).qos,
            (Qos{Qos::Reliability::kBestEffort, Qos::Durability::kVolatile, 5, 200ms}));
  EXPECT_EQ(item(again, 0).readers, (std::vector<std::string>{"base", "r*"}));
  EXPECT_EQ(std::get<SizeRange>(item(again, 1).sizes).to, 2'000'000u);
  EXPECT_EQ(std::get<PoissonSamples>(item(again, 1).rhythm).rate, 3);
  EXPECT_EQ(item(again, 1).qos,
            (Qos{Qos::Reliability::kReliable, Qos::Durability::kTransientLocal, {}, {}}));
  EXPECT_EQ(std::get<SampleBursts>(item(again, 2).rhythm).samples, 20u);
  EXPECT_EQ(std::get<SampleBursts>(item(again, 2).rhythm).spacing, 1ms);
  EXPECT_EQ(item(again, 3).recorded.from, kBag);
  EXPECT_TRUE(item(again, 3).recorded.repeats);
  EXPECT_EQ(item(again, 3).recorded.depth, std::optional<std::uint32_t>{3});
  const DdsKeys& dds = again.groups.back().dds;
  EXPECT_EQ(dds.vendor, DdsVendor::kFastDds);
  EXPECT_EQ(dds.domain, 3u);
  EXPECT_EQ(dds.start, 200ms);
  EXPECT_EQ(dds.begin, 2s);
}

TEST_F(Topics, ArePlayedByWritersAndReadersOnly) {
  const Scenario scenario = loaded("      - {name: a, size: 8 B, rate: 1 Hz, readers: [base]}\n",
                                   "dds: {vendor: fastdds, start: 200 ms}");
  std::vector<std::string> players;
  for (const PlannedProgram& planned : plan_programs(scenario)) {
    EXPECT_TRUE(planned.program->is_shipped);
    players.push_back(planned.agent_name + " " + planned.program->command.front());
  }
  // The base starts at 0 s, the robots at 0.2 s.
  EXPECT_EQ(players,
            (std::vector<std::string>{"base baraka-topics-cyclonedds", "r0 baraka-topics-fastdds",
                                      "r1 baraka-topics-fastdds"}));
}

TEST_F(Topics, AreReadByAllAgentsMeantButTheWriter) {
  const Scenario scenario = loaded(
      "      - {name: \"rt/{agent}/odom\", size: 8 B, rate: 1 Hz, readers: [base, \"r?\"]}\n"
      "      - {name: tf, size: 8 B, rate: 1 Hz, readers: [\"r*\"]}\n");
  Recordings none;
  const auto names = [&](const char* agent) {
    const auto& all = scenario.simulation.agents;
    const auto id = std::ranges::find(all, agent, &agents::AgentConfig::name)->id;
    std::vector<std::string> read;
    for (const TopicPart& part : read_topics(scenario, id, none)) read.push_back(part.name);
    return read;
  };
  EXPECT_EQ(names("base"), (std::vector<std::string>{"rt/r0/odom", "rt/r1/odom"}));
  EXPECT_EQ(names("r0"), (std::vector<std::string>{"rt/r1/odom", "tf"}));
  EXPECT_EQ(names("idle"), std::vector<std::string>{});
}

TEST_F(Topics, OfARecordingGetTheAgentsNamespaceAndKeepTheirQos) {
  const Scenario scenario = loaded("      - {from: " + kBag +
                                   ", rename: {rt/tf_static: rt/tf_static}, readers: [base]}\n");
  Recordings recordings;
  const Group& robots = scenario.groups.back();
  const auto parts = written_topics(scenario, robots, robots.agents.at(1), recordings);
  ASSERT_EQ(parts.size(), 3u);
  const auto part = [&](const std::string& name) {
    return *std::ranges::find(parts, name, &TopicPart::name);
  };
  ASSERT_EQ(std::ranges::count(parts, "rt/r1/scan", &TopicPart::name), 1);
  ASSERT_EQ(std::ranges::count(parts, "rt/tf_static", &TopicPart::name), 1);
  EXPECT_EQ(part("rt/r1/scan").qos.reliability, Qos::Reliability::kBestEffort);
  EXPECT_EQ(part("rt/tf_static").qos.durability, Qos::Durability::kTransientLocal);
  EXPECT_EQ(part("rt/r1/scan").recorded->samples.size(), 10u);
  EXPECT_TRUE(recording_mistakes(scenario).empty());
}

TEST_F(Topics, OfARecordingCanBeChosenAndTheirQosStated) {
  const Scenario scenario = loaded("      - {from: " + kBag +
                                   ", name: \"*/scan\", reliability: reliable, history: all, "
                                   "readers: [base]}\n");
  Recordings recordings;
  const Group& robots = scenario.groups.back();
  const auto parts = written_topics(scenario, robots, robots.agents.front(), recordings);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].qos, (Qos{Qos::Reliability::kReliable, Qos::Durability::kVolatile, {}, {}}));
}

TEST_F(Topics, OfARecordingThatItDoesNotHaveAreMistakes) {
  const auto mistakes = [&](const std::string& keys) {
    const auto found =
        recording_mistakes(loaded("      - {from: " + kBag + ", " + keys + ", readers: [base]}\n"));
    return found.empty() ? "" : found.front();
  };
  EXPECT_TRUE(mistakes("name: \"*/image\"")
                  .ends_with(":9: topics.from: plain.mcap has no topic like '*/image'"));
  EXPECT_TRUE(mistakes("rename: {rt/image: x}")
                  .ends_with("topics.rename: plain.mcap has no topic 'rt/image'"));
  EXPECT_TRUE(
      mistakes("rename: {rt/scan: x, rt/odom: x}").ends_with("topics: r0 writes 'x' twice"));
}

TEST_F(Topics, ShareOutParticipantsAsTheirItemSays) {
  const std::string rest = ", size: 8 B, rate: 1 Hz, readers: [base]";
  const std::string capture = TESTS_DIR "/unit/sim/air/ledger/captures/cyclone_v4.pcap";
  const Scenario scenario =
      loaded("      - {name: a" + rest + "}\n      - {name: b, participants: topic" + rest +
             "}\n      - {from: " + kBag + ", readers: [base]}\n      - {from: " + capture +
             ", name: \"DDSPerf?Data*\", readers: [base]}\n      - {from: " + capture +
             ", name: \"DDSPerf?Data*\", participants: agent, rename: {DDSPerfRDataKS: x, "
             "DDSPerfUDataKS: y}, "
             "readers: [base]}\n");
  Recordings recordings;
  const Group& group = scenario.groups.back();
  std::map<std::string, std::pair<std::string, std::string>> names;
  for (const TopicPart& part : written_topics(scenario, group, group.agents[0], recordings))
    names[part.name] = {writing_participant(part), reading_participant(part)};
  const std::pair<std::string, std::string> common;
  EXPECT_EQ(names.at("a"), common);
  EXPECT_EQ(names.at("b").first, "topic b");
  EXPECT_EQ(names.at("b").second, "topic b");
  EXPECT_EQ(names.at("rt/r0/scan"), common);  // a bag does not tell
  EXPECT_EQ(names.at("x"), common);
  const auto& [writer, reader] = names.at("r0/DDSPerfRDataKS");
  EXPECT_NE(writer, reader);
  EXPECT_THAT(writer, testing::HasSubstr(capture));
  EXPECT_THAT(reader, testing::HasSubstr(capture));
}

TEST_F(Topics, RefuseParticipantsThatThereAreNot) {
  const auto refused = [&](const std::string& item) {
    try {
      loaded("      - {" + item + ", readers: [base]}\n");
    } catch (const hal::files::config::ConfigErrors& e) {
      return e.messages().at(0);
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refused("name: a, size: 8 B, rate: 1 Hz, participants: recorded"),
              testing::AllOf(testing::HasSubstr("robots.yaml:"), testing::HasSubstr("recorded")));
  EXPECT_THAT(refused("from: " + kBag + ", spread: 2 s"), testing::HasSubstr("spread"));
}

}  // namespace
}  // namespace sim::scenario
