#include <gtest/gtest.h>

#include <fmt/format.h>

#include <map>
#include <sstream>
#include <tuple>

#include "tests/support/output_of.h"
#include "tests/unit/sim/air/ledger/replay.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;

radio::RadioConfig lossless() {
  radio::RadioConfig config = radio::profile_defaults(radio::Profile::kIeee80211g);
  radio::dcf_of(config)->contention.queue_limit = 1000;
  return config;
}

class Captured : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Of, Captured,
                         testing::Values("cyclone_v4", "cyclone_v6", "fastdds_v4", "fastdds_v6"),
                         [](const auto& c) { return std::string(c.param); });

// Profiles with and without carrier sense, queues that overflow, losses that cause retries, and a
// run that ends within a frame.
TEST_P(Captured, SumsAreTheRadiosInEveryProfile) {
  for (const auto profile :
       {radio::Profile::kMobilityFramework, radio::Profile::kIeee80211b,
        radio::Profile::kIeee80211g, radio::Profile::kIeee80211n, radio::Profile::kIeee80211ac,
        radio::Profile::kIeee80211ax, radio::Profile::kDisk, radio::Profile::kIdeal}) {
    SCOPED_TRACE(static_cast<int>(profile));
    Replay replay(radio::profile_defaults(profile));
    if (auto* const waves = radio::waves_of(replay.config.radio))
      waves->receiver.loss.probability = 0.3;
    replay.antennas.place(hal::AgentId{3}, {{150, 0, 0}, {-1, 0, 0}});
    replay.build();
    replay.send(read_capture(GetParam()));
    replay.run(3'000'123'456ns);
    expect_sums_of_the_radio(replay);
  }
}

// Each frame is on the air twice, from its sender and from the access point, who both have an
// account of it; what the access point passes on is no repair.
TEST_P(Captured, SumsAreTheRadiosThroughAnAccessPoint) {
  Replay replay(lossless(), 4);
  radio::dcf_of(replay.config.radio)->bss.access_points = {"s4"};
  replay.build();
  std::vector<Packet> packets = read_capture(GetParam());
  for (Packet& packet : packets) packet.at += 1s;  // until they are associated
  replay.send(packets);
  replay.run(20s);
  expect_sums_of_the_radio(replay);
  const std::string of_4 = "SELECT COUNT(*) FROM air_accounts WHERE agent = 4 AND kind = ";
  EXPECT_NE(replay.ask(of_4 + "'beacon'"), "0");
  EXPECT_NE(replay.ask(of_4 + "'DATA' AND purpose = 'SPDP'"), "0");
  EXPECT_NE(replay.ask("SELECT SUM(delivered) FROM sample_sums"), "null");
  EXPECT_EQ(replay.ask("SELECT SUM(first_try) FROM sample_sums"),
            replay.ask("SELECT SUM(samples) FROM sample_sums"));
}

using Counts = std::map<std::tuple<std::string, std::string, bool>, int>;

/// Of the submessages that have a writer, by kind, its entity and whether they were sent before.
Counts counts_of_tshark(const Replay& replay) {
  const std::string command =
      "tshark -n -o udp.try_heuristic_first:TRUE -o ip.defragment:TRUE -r '" +
      (replay.folder.path() / "air.pcapng").string() +
      "' -Y 'rtps && !icmp && !icmpv6' -T pdml 2>/dev/null";
  Counts counts;
  std::string kind;
  bool retry = false;
  std::istringstream lines(tests::output_of(command));
  for (std::string line; std::getline(lines, line);) {
    const auto value = [&line](const std::string& attribute) {
      const std::size_t at = line.find(" " + attribute + "=\"");
      if (at == std::string::npos) return std::string();
      const std::size_t begin = at + attribute.size() + 3;
      return line.substr(begin, line.find('"', begin) - begin);
    };
    if (line.find("name=\"wlan.fc.retry\"") != std::string::npos)
      retry = value("show") != "0" && value("show") != "False";
    if (line.find("name=\"rtps.sm.id\"") != std::string::npos) {
      kind = value("value").substr(0, 2);
      ++counts[{kind, "", retry}];
    }
    if (line.find("name=\"rtps.sm.wrEntityId\"") != std::string::npos)
      ++counts[{kind, value("value"), retry}];
  }
  return counts;
}

/// The same of the ledger.
Counts counts_of(const Ledger& ledger) {
  Counts counts;
  for (const WriterAccount& one : ledger.accounts().writers()) {
    if (!is_rtps(one.kind.purpose)) continue;
    const std::string kind = fmt::format("{:02x}", one.kind.what);
    const std::uint32_t entity = ledger.endpoints().all()[one.writer].guid.entity.value;
    for (const bool retry : {false, true}) {
      const auto count = static_cast<int>(retry ? one.repeated : one.submessages);
      if (count == 0) continue;
      counts[{kind, "", retry}] += count;
      const bool has_writer = one.writer != 0;
      if (has_writer) counts[{kind, fmt::format("{:08x}", entity), retry}] += count;
    }
  }
  return counts;
}

std::string text_of(const Counts& counts) {
  std::string text;
  for (const auto& [key, count] : counts) {
    const auto& [kind, writer, retry] = key;
    text += fmt::format("0x{} of {}{}: {}\n", kind, writer.empty() ? "all" : writer,
                        retry ? " again" : "", count);
  }
  return text;
}

TEST_P(Captured, SubmessagesAreThoseThatTsharkSees) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  Replay replay(lossless());
  replay.build();
  replay.send(read_capture(GetParam()));
  replay.run(20s);
  expect_sums_of_the_radio(replay);
  const std::string seen = text_of(counts_of_tshark(replay));
  EXPECT_GT(seen.size(), 200U);
  EXPECT_EQ(text_of(counts_of(replay.ledger())), seen);
}

struct Expected {
  const char* capture;
  const char* topic;
  std::uint64_t samples;
  std::uint64_t fragments;
};

// Samples of the publisher at the one subscriber that its topic and QoS match: as many as tshark
// lists in the capture, as DATA or in so many fragments of RTPS.
class SamplesOf : public testing::TestWithParam<Expected> {};
INSTANTIATE_TEST_SUITE_P(Captures, SamplesOf,
                         testing::Values(Expected{"cyclone_v4", "DDSPerfRDataKS", 4, 52},
                                         Expected{"cyclone_v6", "DDSPerfUDataKS", 9, 63},
                                         Expected{"fastdds_v4", "camera", 1, 2},
                                         Expected{"fastdds_v6", "camera", 7, 7}),
                         [](const auto& c) { return std::string(c.param.capture); });

TEST_P(SamplesOf, ComeAtTheFirstTryWhereNothingIsLost) {
  Replay replay(lossless());
  replay.build();
  replay.send(read_capture(GetParam().capture));
  replay.run(20s);
  const std::string text = std::to_string(GetParam().samples);
  const std::string of = std::string(" FROM air_topics WHERE topic = '") + GetParam().topic + "'";
  EXPECT_EQ(replay.ask("SELECT samples" + of), text);
  EXPECT_EQ(replay.ask("SELECT first_try" + of), text);
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM samples WHERE repaired = 0 AND verdict IS NULL"),
            text);
  EXPECT_EQ(replay.ask("SELECT SUM(fragments) FROM sample_sums"),
            std::to_string(GetParam().fragments));
  EXPECT_EQ(replay.ask("SELECT SUM(left_ns - entered_ns) FROM samples"),
            replay.ask("SELECT SUM(latency_sum_ns) FROM sample_sums"));
  EXPECT_EQ(replay.ask("SELECT SUM(count) FROM sample_latencies"), text);
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM samples s JOIN dds_endpoints e ON e.guid = s.writer"
                       " WHERE e.agent = 1 AND s.receiver = 2 AND e.kind = 'writer'"),
            text);
}

// The subscriber switches its radio off, once it is known: the samples are lost, each with the
// frame of which its verdict is.
void expect_losses_with_frames(const char* capture, const radio::RadioConfig& radio) {
  Replay replay(radio);
  replay.build();
  replay.send(read_capture(capture));
  replay.events.schedule(hal::Time{1500ms}, Rank::kScenario, kWorld,
                         [&replay] { replay.network->sap(hal::AgentId{2}).set_radio(false); });
  replay.run(20s);
  expect_sums_of_the_radio(replay);
  EXPECT_NE(replay.ask("SELECT SUM(samples) - SUM(delivered) FROM sample_sums"), "0");
  EXPECT_EQ(replay.ask("SELECT SUM(samples) - SUM(delivered) - SUM(under_way) FROM sample_sums"),
            replay.ask("SELECT IFNULL(SUM(count), 0) FROM sample_losses"));
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM samples s WHERE s.frame IS NOT NULL AND NOT EXISTS"
                       " (SELECT 1 FROM frame_ends e WHERE e.frame = s.frame AND"
                       " e.agent = s.receiver AND e.verdict = s.verdict)"),
            "0");
}

TEST_P(SamplesOf, AreLostWithAVerdictAndAFrameOfIt) {
  expect_losses_with_frames(GetParam().capture, lossless());
}

// The same with retries in A-MPDUs, of A-MSDUs, and after RTS.
TEST_P(SamplesOf, AreLostWithAVerdictAndAFrameOfItInAmpdus) {
  radio::RadioConfig config = radio::profile_defaults(radio::Profile::kIeee80211n);
  radio::DcfConfig& dcf = *radio::dcf_of(config);
  dcf.contention.queue_limit = 1000;
  for (const std::uint32_t max_amsdu : {0U, 3839U}) {
    for (const std::uint32_t rts_threshold : {65'535U, 500U}) {
      SCOPED_TRACE(fmt::format("{} {}", max_amsdu, rts_threshold));
      dcf.aggregation.max_amsdu = max_amsdu;
      dcf.contention.rts_threshold = rts_threshold;
      expect_losses_with_frames(GetParam().capture, config);
    }
  }
}

}  // namespace
}  // namespace sim::air::test
