#include "results/record/run_difference.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Two frames of m0 with their ends at m1, and a packet of m0's programs before them: UDP from port
/// 40000 to 5000 with the payload "ab".
constexpr const char* kPacket =
    "020000000002020000000001080045000"
    "01e00010000401100000a4d00010a4d00029c401388000a00006162";

struct TinyRun {
  std::string pace = "lockstep", listing = "all", digest = "0123456789abcdef";
  std::string packet = kPacket;
  std::string more{};  ///< SQL

  std::string sql() const {
    return fmt::format(
        "INSERT INTO run VALUES ('scenario', 'tiny'), ('seed', 1), ('version', '0.1'), "
        "('pace', '{0}'), ('result', 'done'), ('ended_ns', 9000000000), "
        "('fingerprint', 'fedcba9876543210'), ('frames_digest', '{2}');"
        "INSERT INTO settings VALUES ('record.frames', '{1}'), ('seed', '1');"
        "INSERT INTO agents VALUES (1, 'm0', 'mote', '', 0, 0, 0), (2, 'm1', 'mote', '', 1, 0, 0);"
        "INSERT INTO arrivals VALUES (5, 'air of m0', '{3}');"
        "INSERT INTO frames VALUES (281474976710657, 10, 'unicast', 1, 2, 7, 0, 800, 100000, 300, "
        "11000000, NULL, NULL, NULL, 'IPv4 UDP 40000 > 5000', 77, "
        "0, 100000, 'DSSS', NULL, NULL, NULL, NULL, NULL, NULL, 1, NULL), "
        "(281474976710658, 2000000010, 'unicast', 1, 2, 8, 0, 800, 100000, 300, 11000000, NULL, "
        "NULL, NULL, 'IPv4 UDP 40000 > 5000', 78, "
        "0, 100000, 'DSSS', NULL, NULL, NULL, NULL, NULL, NULL, 1, NULL);"
        "INSERT INTO frame_ends VALUES (281474976710657, 2, 100010, 'delivered', -60.5, 12), "
        "(281474976710658, 2, 2000100010, 'delivered', -60.5, 12);"
        "INSERT INTO fingerprints VALUES (0, 'air', 1, 5), (2, 'air', 1, 6);{4}",
        pace, listing, digest, packet, more);
  }
};

RunDifference compared(const TinyRun& first, const TinyRun& second) {
  const Folder one("one"), other("other");
  make_result(one.path(), first.sql());
  make_result(other.path(), second.sql());
  RunReader a(one.path()), b(other.path());
  return compare_runs(a, b);
}

/// The first difference between TinyRun{} and the same with this SQL after it.
RunDifference::Happening after(const std::string& sql) {
  const RunDifference difference = compared(TinyRun{}, TinyRun{.more = sql});
  EXPECT_FALSE(difference.is_equal());
  return difference.happening.value();
}

TEST(RunDifference, EqualRunsAreEqualAlsoIfOneIsARepetition) {
  const RunDifference difference = compared(TinyRun{}, TinyRun{.pace = "repeated"});
  EXPECT_TRUE(difference.is_equal());
  EXPECT_FALSE(difference.happening || difference.hash);
  EXPECT_THAT(difference.notes, IsEmpty());
  EXPECT_THAT(difference.settings, IsEmpty());
  EXPECT_EQ(difference.causes.at(3).second, "repeated");
}

TEST(RunDifference, OneByteOfAPacketIsFoundWithItsPlace) {
  std::string packet = kPacket;
  packet.back() = '3';
  const auto found = compared(TinyRun{}, TinyRun{.packet = packet}).happening.value();
  EXPECT_EQ(found.at_ns, 5);
  EXPECT_EQ(found.table, "arrivals");
  EXPECT_EQ(found.stations, "m0 to m1");
  EXPECT_EQ(found.protocol, "IPv4 UDP 40000 > 5000");
  EXPECT_EQ(found.what, "byte 43 (UDP payload, byte 1) of 44: 62 | 63");
  EXPECT_EQ(found.before, "");
  EXPECT_EQ(found.first,
            "0.000000005 s: m0 to m1, IPv4 UDP 40000 > 5000: 44 bytes from its interface");
}

TEST(RunDifference, AfterAChecksumTheFirstByteOfThePayloadIsToldToo) {
  std::string packet = kPacket;
  packet.replace(80, 4, "1234");  // checksum
  packet.back() = '3';
  EXPECT_EQ(compared(TinyRun{}, TinyRun{.packet = packet}).happening.value().what,
            "byte 40 (UDP header) of 44: 00 | 12; byte 43 (UDP payload, byte 1): 62 | 63");
}

TEST(RunDifference, WhatIsNoPacketIsComparedByteByByteToo) {
  const auto found = after("UPDATE arrivals SET bytes = '00', door = 'cmd_vel of m0'");
  EXPECT_EQ(found.stations, "m0 to m1 | cmd_vel of m0");
  EXPECT_EQ(found.protocol, "IPv4 UDP 40000 > 5000 | input from outside");
  const char* const drive = "UPDATE arrivals SET door = 'cmd_vel of m0'; ";
  const auto driven =
      compared(TinyRun{.more = drive},
               TinyRun{.more = std::string(drive) + "UPDATE arrivals SET bytes = '03'"});
  EXPECT_EQ(driven.happening.value().what, "byte 0 of 44: 02 | 03, length 44 | 1 bytes");
}

TEST(RunDifference, APacketThatIsLongerIsToldByItsLength) {
  const auto longer =
      compared(TinyRun{}, TinyRun{.packet = std::string(kPacket) + "00"}).happening.value();
  EXPECT_EQ(longer.what, "length 44 | 45 bytes");
}

TEST(RunDifference, AFieldOfAFrameIsFoundWithTheRowBefore) {
  const auto found = after("UPDATE frames SET sequence = 9, retry = 1 WHERE sequence = 8");
  EXPECT_EQ(found.at_ns, 2'000'000'010);
  EXPECT_EQ(found.table, "frames");
  EXPECT_EQ(found.stations, "m0 to m1");
  EXPECT_EQ(found.protocol, "IPv4 UDP 40000 > 5000");
  EXPECT_EQ(found.what, "sequence 8 | 9, retry 0 | 1");
  EXPECT_THAT(found.before, HasSubstr("0.000000010 s: m0 to m1, IPv4 UDP 40000 > 5000: unicast, "
                                      "sequence 7, 800 bit at 11 Mb/s, lasts 100000 ns"));
  EXPECT_THAT(found.second, HasSubstr("sequence 9, 800 bit, a retransmission at 11 Mb/s"));
}

TEST(RunDifference, BytesOfAPayloadThatAreNotListedAreToldByTheirHash) {
  EXPECT_EQ(after("UPDATE frames SET payload_hash = 79 WHERE sequence = 8").what,
            "bytes of the payload (record.air records them)");
}

TEST(RunDifference, AnEndIsFoundWithItsFrame) {
  const auto found =
      after("UPDATE frame_ends SET verdict = 'noise', rssi_dbm = -60.25 WHERE at_ns = 100010");
  EXPECT_EQ(found.table, "frame_ends");
  EXPECT_EQ(found.stations, "m0 to m1, at m1");
  EXPECT_EQ(found.protocol, "IPv4 UDP 40000 > 5000");
  EXPECT_EQ(found.what, "verdict delivered | noise, rssi_dbm -60.5 | -60.25");
}

TEST(RunDifference, OfSeveralTablesTheEarliestDifferenceCounts) {
  const auto found = after(
      "UPDATE frames SET bits = 900 WHERE sequence = 8;"
      "UPDATE frame_ends SET sinr_db = 11 WHERE at_ns = 100010");
  EXPECT_EQ(found.table, "frame_ends");
  EXPECT_EQ(found.what, "sinr_db 12 | 11");
}

TEST(RunDifference, AFrameThatOneRunLacksIsTheFirstDifference) {
  const auto middle = after("DELETE FROM frames WHERE sequence = 7");
  EXPECT_EQ(middle.at_ns, 10);
  EXPECT_THAT(middle.what, HasSubstr("at_ns 10 | 2000000010"));
  const auto last = after("DELETE FROM frames WHERE sequence = 8");
  EXPECT_EQ(last.at_ns, 2'000'000'010);
  EXPECT_EQ(last.what, "");
  EXPECT_EQ(last.second, "");
  EXPECT_THAT(last.first, HasSubstr("sequence 8"));
}

TEST(RunDifference, AgentsOfEachRunHaveTheirOwnNames) {
  const auto found = after(
      "UPDATE agents SET name = 'x' WHERE agent = 1;"
      "UPDATE frames SET bits = 1 WHERE sequence = 7");
  EXPECT_EQ(found.stations, "m0 to m1 | x to m1");
}

TEST(RunDifference, SettingsAndTheFirstHashAreNamed) {
  const RunDifference difference =
      compared(TinyRun{}, TinyRun{.more = "UPDATE settings SET value = '2' WHERE key = 'seed';"
                                          "INSERT INTO settings VALUES ('a', 'b');"
                                          "INSERT INTO fingerprints VALUES (1, 'bodies', 2, 4)"});
  ASSERT_EQ(difference.settings.size(), 2u);
  EXPECT_EQ(difference.settings[0].name, "a");
  EXPECT_EQ(difference.settings[0].first, "");
  EXPECT_EQ(difference.settings[1].second, "2");
  ASSERT_TRUE(difference.hash);
  EXPECT_EQ(difference.hash->second, 1);
  EXPECT_EQ(difference.hash->part, "bodies");
  EXPECT_EQ(difference.hash->agent, "m1");
  EXPECT_FALSE(difference.is_equal());
}

TEST(RunDifference, FramesThatAreNotListedInBothAreNotCompared) {
  const TinyRun other{.listing = "counts", .digest = "1", .more = "DELETE FROM frames"};
  const RunDifference difference = compared(TinyRun{.listing = "counts"}, other);
  EXPECT_FALSE(difference.is_equal());
  EXPECT_FALSE(difference.happening);
  EXPECT_THAT(difference.notes, testing::ElementsAre("frames were not compared: record.frames is "
                                                     "counts; --set record.frames=all lists every "
                                                     "frame"));
  EXPECT_THAT(compared(TinyRun{}, TinyRun{.listing = "sample", .digest = "1"}).notes,
              testing::ElementsAre(HasSubstr("record.frames is all | sample; --set")));
  EXPECT_THAT(compared(TinyRun{.listing = "none"}, TinyRun{.listing = "none"}).notes, IsEmpty())
      << "the digests are equal";
}

TEST(RunDifference, ASampleThatLacksTheFirstDifferenceIsSaid) {
  const std::string hash = "UPDATE fingerprints SET hash = 9 WHERE second = 0;";
  const auto notes = [&](const char* listing, const std::string& sql) {
    return compared(TinyRun{.listing = listing},
                    TinyRun{.listing = listing, .digest = "1", .more = hash + sql})
        .notes;
  };
  EXPECT_THAT(notes("sample", ""),
              testing::ElementsAre(HasSubstr("in second 0, is not among the frames listed: "
                                             "record.frames is sample; --set record.frames=all")));
  EXPECT_THAT(notes("sample", "DELETE FROM frames WHERE sequence = 8"),
              testing::ElementsAre(HasSubstr("second 0")))
      << "what is listed differs later";
  EXPECT_THAT(notes("sample", "DELETE FROM frames WHERE sequence = 7"), IsEmpty());
  EXPECT_THAT(notes("all", ""), testing::ElementsAre(HasSubstr("second 0, is nothing that")));
}

TEST(RunDifference, ARunWithoutADigestIsComparedByItsRows) {
  EXPECT_TRUE(compared(TinyRun{}, TinyRun{.digest = ""}).is_equal());
  EXPECT_FALSE(compared(TinyRun{}, TinyRun{.digest = "1"}).is_equal());
}

TEST(RunDifference, DamagedBytesAreRefusedByRow) {
  try {
    compared(TinyRun{}, TinyRun{.packet = "0g"});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), HasSubstr("table arrivals, row 1: bytes is '0g', not hexadecimal"));
  }
}

}  // namespace
}  // namespace results::record::test
