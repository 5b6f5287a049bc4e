#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/output_of.h"
#include "tests/unit/sim/air/ledger/dds_packets.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;

using Lines = std::vector<std::string>;

struct Cell {
  const char* name;
  radio::Profile profile;
  std::uint32_t max_amsdu = 0;  ///< Bytes
  bool has_rts = false;
};

constexpr std::uint16_t kPackets = 600;

/// Three stations that have more to send than the air can carry, in two access categories: DATA of
/// RTPS in packets of IP, from 1 and 3 to 2 and from 2 to 1, each tenth urgent.
class SaturatedReplay : public Replay {
 public:
  /// @param loss  share of the frames that are lost.
  SaturatedReplay(const Cell& cell, double loss) : Replay(radio::profile_defaults(cell.profile)) {
    radio::DcfConfig& dcf = *radio::dcf_of(config.radio);
    dcf.contention.queue_limit = 2 * kPackets;
    dcf.aggregation.max_amsdu = cell.max_amsdu;
    dcf.receiver.loss.probability = loss;
    if (cell.has_rts) dcf.contention.rts_threshold = 500;
    build();
    for (std::uint16_t i = 0; i < kPackets; ++i) {
      const auto from = static_cast<std::uint16_t>(i % 3 + 1);
      const hal::Bytes message = Rtps(static_cast<std::uint8_t>(from))
                                     .data(0x103, i + 1U, hal::Bytes(i % 7U * 150U + 100U, 1))
                                     .bytes();
      const AgentId to{static_cast<std::uint16_t>(from == 2 ? 1 : 2)};
      auto packets = udp(1ms, from, to, message, i);
      packets.front().priority = i % 10 == 0 ? 6 : 0;
      send(packets);
    }
  }
};

Lines lines_of(const std::string& text) {
  Lines lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

/// What tshark prints of each packet, sorted; fields that a packet does not have are empty.
Lines tshark(const Replay& replay, const Lines& fields, const std::string& filter = "") {
  std::string command = "tshark -n -r '" + (replay.folder.path() / "air.pcapng").string() +
                        "' -o wlan.check_checksum:TRUE -T fields -E separator=, -E occurrence=f";
  for (const std::string& name : fields) command += " -e " + name;
  if (!filter.empty()) command += " -Y '" + filter + "'";
  return lines_of(tests::output_of(command + " 2>/dev/null"));
}

/// A cell of which a tenth of the frames is lost, as recorded and as tshark reads its capture: once
/// for all tests, for tshark takes a third of a second to start.
class Dissection {
 public:
  static const Dissection& of(const Cell& cell) {
    static std::map<std::string, std::unique_ptr<Dissection>> made;
    auto& one = made[cell.name];
    if (!one) one = std::make_unique<Dissection>(cell);
    return *one;
  }

  explicit Dissection(const Cell& cell) : replay_(cell, 0.1) {
    replay_.run(3s);
    for (const std::string& line : tshark(replay_, kFields)) {
      auto& packet = packets_.emplace_back();
      std::size_t begin = 0;
      for (const std::string& field : kFields) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        packet[field] = line.substr(begin, end - begin);
        begin = std::min(end + 1, line.size());
      }
    }
  }

  const Replay& replay() const { return replay_; }

  /// Some of its fields of each packet, sorted.
  /// @param having  only of packets with this field.
  Lines fields(const Lines& names, const std::string& having = "") const {
    Lines lines;
    for (const auto& packet : packets_) {
      if (!having.empty() && packet.at(having).empty()) continue;
      std::string line;
      for (const std::string& name : names) line += (line.empty() ? "" : ",") + packet.at(name);
      lines.push_back(line);
    }
    std::ranges::sort(lines);
    return lines;
  }

 private:
  inline static const Lines kFields{"wlan.fc.type_subtype",
                                    "wlan.ra",
                                    "wlan.ta",
                                    "wlan.seq",
                                    "wlan.fc.retry",
                                    "wlan.qos.tid",
                                    "wlan.qos.amsdupresent",
                                    "wlan.fcs.status",
                                    "radiotap.ampdu.reference",
                                    "radiotap.ampdu.flags.last",
                                    "frame.time_epoch",
                                    "radiotap.mcs.index",
                                    "radiotap.vht.mcs.0",
                                    "radiotap.he.data_3.data_mcs",
                                    "_ws.malformed"};
  SaturatedReplay replay_;
  std::vector<std::map<std::string, std::string>> packets_;
};

class Saturated : public testing::TestWithParam<Cell> {
 protected:
  /// The rows of a query, columns separated by spaces, sorted.
  static Lines rows(const Replay& replay, const std::string& columns, const std::string& rest) {
    return lines_of(replay.ask("SELECT group_concat(line, char(10)) FROM (SELECT " + columns +
                               " AS line " + rest + ")"));
  }
};

INSTANTIATE_TEST_SUITE_P(Cells, Saturated,
                         testing::Values(Cell{"n", radio::Profile::kIeee80211n},
                                         Cell{"n_rts", radio::Profile::kIeee80211n, 0, true},
                                         Cell{"n_amsdu", radio::Profile::kIeee80211n, 3839},
                                         Cell{"ac", radio::Profile::kIeee80211ac},
                                         Cell{"ac_amsdu", radio::Profile::kIeee80211ac, 7935},
                                         Cell{"ax", radio::Profile::kIeee80211ax}),
                         [](const auto& c) { return std::string(c.param.name); });

TEST_P(Saturated, SumsAreTheRadios) {
  SaturatedReplay replay(GetParam(), 0.1);
  replay.run(3s);
  expect_sums_of_the_radio(replay);
  EXPECT_NE(replay.ask("SELECT COUNT(DISTINCT ampdu) FROM frames WHERE transmitter = 1"), "1");
  EXPECT_NE(replay.ask("SELECT COUNT(*) FROM frames WHERE class = 'block_ack'"), "0");
  // The parts of an A-MPDU add up to it.
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM (SELECT 1 FROM frames WHERE ampdu > 0"
                       " GROUP BY transmitter, ampdu HAVING SUM(airtime_ns) <> MAX(ppdu_ns)"
                       " OR MIN(ppdu_ns) <> MAX(ppdu_ns) OR MIN(at_ns) <> MAX(at_ns))"),
            "0");
}

// The run ends, or a sender is switched off, at many instants, of which most are within an A-MPDU.
TEST_P(Saturated, SumsAreTheRadiosWhereAnAmpduIsCut) {
  int under_way = 0;
  for (int i = 0; i < 12; ++i) {
    const hal::Duration cut = 3ms + i * 617us;
    SCOPED_TRACE(cut.count());
    SaturatedReplay replay(GetParam(), 0.1);
    replay.events.schedule(hal::Time{} + cut, Rank::kScenario, kWorld, [&] {
      if (i % 2 == 0) replay.network->sap(AgentId{1}).set_radio(false);
    });
    replay.run(i % 2 == 0 ? 30ms : cut);
    expect_sums_of_the_radio(replay);
    under_way += std::stoi(replay.ask("SELECT IFNULL(SUM(frames), 0) FROM in_the_air"));
    // Each frame has an outcome at each of the two other radios.
    EXPECT_EQ(replay.ask("SELECT SUM(count) FROM verdict_sums"),
              replay.ask("SELECT 2 * SUM(count) FROM frames_sent"));
    EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM verdict_sums WHERE count < 0"), "0");
  }
  EXPECT_GT(under_way, 6) << "some of them were";
}

// Each packet of a program is accounted for once when it is first sent, whatever it is sent in.
TEST_P(Saturated, EachMsduIsAccountedFor) {
  SaturatedReplay replay(GetParam(), 0);
  replay.run(3s);
  EXPECT_EQ(replay.ask("SELECT SUM(submessages) FROM air_accounts WHERE kind = 'DATA'"),
            std::to_string(kPackets));
  const bool has_amsdus = GetParam().max_amsdu > 0;
  EXPECT_EQ(replay.ask("SELECT COUNT(*) > 0 FROM frames WHERE msdus > 1"), has_amsdus ? "1" : "0");
  EXPECT_EQ(replay.ask("SELECT IFNULL(SUM(msdus), 0) FROM frames WHERE msdus > 1"),
            replay.ask("SELECT COUNT(*) FROM msdus"));
  EXPECT_EQ(replay.ask("SELECT COUNT(*) FROM msdus WHERE protocol NOT LIKE 'IPv4 UDP 7411%'"), "0");
  EXPECT_EQ(replay.ask("SELECT COUNT(DISTINCT payload_hash) FROM (SELECT payload_hash FROM msdus"
                       " UNION SELECT payload_hash FROM frames WHERE msdus = 1 AND tid NOT NULL)"),
            std::to_string(kPackets));
}

std::string address_sql(const std::string& column) {
  return "printf('02:00:00:00:00:%02x', " + column + ")";
}

/// What `wlan.fc.type_subtype` of tshark is, from a row of the table frames.
constexpr const char* kSubtypeSql =
    "CASE class WHEN 'unicast' THEN '0x0028' WHEN 'rts' THEN '0x001b' WHEN 'cts' THEN '0x001c'"
    " WHEN 'ack' THEN '0x001d' WHEN 'management' THEN '0x000d' WHEN 'block_ack' THEN"
    " CASE instr(block_ack, ':') WHEN 0 THEN '0x0018' ELSE '0x0019' END END";

// Every subframe of every A-MPDU is in the capture, and the capture holds nothing else.
TEST_P(Saturated, TsharkReadsEveryFrameAsItIsInTheRecord) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  const Dissection& shown = Dissection::of(GetParam());
  EXPECT_EQ(shown.fields({"_ws.malformed"}, "_ws.malformed"), Lines{});
  for (const std::string& status : shown.fields({"wlan.fcs.status"})) EXPECT_EQ(status, "1");
  const std::string frames =
      std::string(kSubtypeSql) + " || ',' || " + address_sql("receiver") +
      " || ',' || CASE WHEN class IN ('cts', 'ack') THEN '' ELSE " + address_sql("transmitter") +
      " END || ',' || CASE WHEN class IN ('unicast', 'management') THEN sequence ELSE '' END"
      " || ',' || retry || ',' || CASE class WHEN 'unicast' THEN tid ELSE '' END || ',' ||"
      " CASE class WHEN 'unicast' THEN msdus > 1 ELSE '' END";
  const Lines recorded = rows(shown.replay(), frames, "FROM frames");
  EXPECT_GT(recorded.size(), 100U);
  EXPECT_EQ(shown.fields({"wlan.fc.type_subtype", "wlan.ra", "wlan.ta", "wlan.seq", "wlan.fc.retry",
                          "wlan.qos.tid", "wlan.qos.amsdupresent"}),
            recorded);
}

TEST_P(Saturated, TsharkReadsTheBitmapsOfBlockAcks) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  SaturatedReplay replay(GetParam(), 0.3);
  replay.run(3s);
  const std::string fields =
      std::string(kSubtypeSql) + " || ',' || " + address_sql("receiver") +
      " || ',' || printf('0x%04x', tid) || ',' || CAST(block_ack AS INTEGER) || ',' || CASE"
      " WHEN instr(block_ack, ':') > 0 THEN"
      " substr(block_ack, instr(block_ack, ':') + 1) ELSE '' END";
  const Lines recorded = rows(replay, fields, "FROM frames WHERE class = 'block_ack'");
  EXPECT_GT(recorded.size(), 5U);
  EXPECT_EQ(tshark(replay,
                   {"wlan.fc.type_subtype", "wlan.ra", "wlan.ba.basic.tidinfo",
                    "wlan.fixed.ssc.sequence", "wlan.ba.bm"},
                   "wlan.fc.type_subtype == 0x18 || wlan.fc.type_subtype == 0x19"),
            recorded);
  // Some of them have gaps: what was lost is repeated.
  EXPECT_NE(replay.ask("SELECT COUNT(*) FROM frames WHERE ampdu > 0 AND retry = 1"), "0");
}

TEST_P(Saturated, TsharkGroupsTheFramesIntoAmpdusAsTheyWereSent) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  const Dissection& shown = Dissection::of(GetParam());
  const std::string reference = "radiotap.ampdu.reference";
  // As many A-MPDUs of each length, whose last MPDU alone says so.
  std::map<std::string, int> lengths;
  for (const std::string& one : shown.fields({"wlan.ta", reference}, reference)) ++lengths[one];
  Lines groups;
  for (const auto& [one, length] : lengths)
    groups.push_back(fmt::format("{} {}", one.substr(0, one.find(',')), length));
  std::ranges::sort(groups);
  EXPECT_EQ(groups, rows(shown.replay(), address_sql("transmitter") + " || ' ' || COUNT(*)",
                         "FROM frames WHERE ampdu > 0 GROUP BY transmitter, ampdu"));
  const Lines last = shown.fields({"radiotap.ampdu.flags.last"}, reference);
  EXPECT_EQ(static_cast<std::size_t>(std::ranges::count(last, "1")), lengths.size());
  // The time of its end is that of all of its frames.
  Lines times = shown.fields({reference, "frame.time_epoch"}, reference);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  EXPECT_EQ(times.size(), lengths.size());
}

TEST_P(Saturated, TsharkReadsTheModeOfEachFrame) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  const Dissection& shown = Dissection::of(GetParam());
  const char* mcs = "radiotap.mcs.index";
  if (GetParam().profile == radio::Profile::kIeee80211ac) mcs = "radiotap.vht.mcs.0";
  if (GetParam().profile == radio::Profile::kIeee80211ax) mcs = "radiotap.he.data_3.data_mcs";
  const std::string shape =
      GetParam().profile == radio::Profile::kIeee80211ax ? "printf('0x%04x', mcs)" : "mcs";
  EXPECT_EQ(
      shown.fields({mcs, "wlan.seq", "wlan.ta"}, mcs),
      rows(shown.replay(), shape + " || ',' || sequence || ',' || " + address_sql("transmitter"),
           "FROM frames WHERE mcs NOT NULL"));
}

}  // namespace
}  // namespace sim::air::test
