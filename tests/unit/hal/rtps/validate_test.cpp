#include "hal/rtps/validate.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/unit/hal/rtps/datagrams.h"

namespace hal::rtps {
namespace {

TEST(Validate, FindsNothingWrongWithWhatRealImplementationsSend) {
  for (const char* implementation : {"fast_dds", "cyclone_dds"}) {
    for (const Datagram& one : recorded(implementation)) {
      const auto result = validate(octets_of(one));
      EXPECT_TRUE(result) << implementation << ": " << result.error().message;
      EXPECT_FALSE(fault_in(octets_of(one), {.relayed_discovery = false})) << implementation;
    }
  }
}

struct Case {
  std::string submessages;
  std::string fault;  ///< Of the datagram; empty: none.
};
class Judged : public testing::TestWithParam<Case> {};

TEST_P(Judged, AsTheStandardHasIt) {
  const auto result = validate(octets_of(datagram(GetParam().submessages)));
  EXPECT_EQ(result ? "" : result.error().message, GetParam().fault);
}

// Reader, writer, sequence number 1: of a user's DATA, little endian.
const std::string kToUser = "00000107 00000102 00000000 01000000 ";
const std::string kSpdp = "000100c7 000100c2 00000000 01000000 ";

INSTANTIATE_TEST_SUITE_P(
    Data, Judged,
    testing::Values(
        Case{"1505 1c00 0000 1000 " + kToUser + "00010000 2a000000", ""},
        Case{"1505 1000 0000 1000 00000107 00000102 00000000", "octet 20: DATA: it is too short"},
        Case{"1505 1c00 0000 1000 00000107 00000102 00000000 00000000 00010000 2a000000",
             "octet 20: DATA: its sequence number is below 1"},
        Case{"1505 1c00 0000 1000 00000107 00000102 ffffffff 01000000 00010000 2a000000",
             "octet 20: DATA: its sequence number is below 1"},
        Case{"1505 1c00 0000 0c00 " + kToUser + "00010000 2a000000",
             "octet 20: DATA: its inline QoS begins within its header"},
        Case{"1505 1c00 0000 1200 " + kToUser + "00010000 2a000000",
             "octet 20: DATA: its inline QoS begins too far away, or between two words"},
        Case{"1505 1c00 0000 fcff " + kToUser + "00010000 2a000000",
             "octet 20: DATA: its inline QoS begins too far away, or between two words"},
        Case{"1505 1c00 0000 fc7f " + kToUser + "00010000 2a000000",
             "octet 20: DATA: its inline QoS begins beyond its end"},
        // With 4 octets between the writer's number and the payload, for a later version.
        Case{"1505 2000 0000 1400 " + kToUser + "deadbeef 00010000 2a000000", ""},
        Case{"1505 1400 0000 1000 " + kToUser, "octet 20: DATA: its payload is too short"},
        Case{"150d 1c00 0000 1000 " + kToUser + "00010000 2a000000",
             "octet 20: DATA: it says to hold data and a key"},
        Case{"1501 1400 0000 1000 " + kToUser,
             "octet 20: DATA: it holds neither data, key nor status"},
        // Inline QoS: a status, a key hash.
        Case{"1503 2000 0000 1000 " + kToUser + "71000400 00000003 01000000", ""},
        Case{"1503 1c00 0000 1000 " + kToUser + "71000400 00000003",
             "octet 20: DATA: a list of parameters has no end"},
        Case{"1503 2400 0000 1000 " + kToUser + "71000800 00000003 00000000 01000000",
             "octet 20: DATA: a status has not 4 octets"},
        Case{"1507 2800 0000 1000 " + kToUser + "70000800 0000000000000000 01000000 00010000",
             "octet 20: DATA: a key hash has not 16 octets"},
        Case{"1507 2000 0000 1000 " + kToUser + "70001000 00000000 01000000",
             "octet 20: DATA: a parameter is longer than its list"},
        Case{"1507 2000 0000 1000 " + kToUser + "44800300 00000000 01000000",
             "octet 20: DATA: the length of a parameter is no multiple of 4"}));

// First fragment, fragments, their size, size of the sample; flags E and, of a key, K.
INSTANTIATE_TEST_SUITE_P(
    DataFrag, Judged,
    testing::Values(
        Case{"1601 2400 0000 1c00 " + kToUser + "02000000 0100 0800 0c000000 01020304", ""},
        Case{"1601 2400 0000 1c00 " + kToUser + "00000000 0100 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: its first fragment has the number 0"},
        Case{"1601 2400 0000 1c00 " + kToUser + "02000000 0000 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: it has no fragment"},
        Case{"1601 2400 0000 1c00 " + kToUser + "02000000 0100 0000 0c000000 01020304",
             "octet 20: DATA_FRAG: its fragments have no size"},
        Case{"1601 2400 0000 1c00 " + kToUser + "03000000 0100 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: its fragments are beyond the end of their sample"},
        Case{"1601 2400 0000 1c00 " + kToUser + "01000000 0100 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: its fragments are longer than it"},
        Case{"1601 2800 0000 1c00 " + kToUser + "02000000 0100 0800 0c000000 0102030405060708",
             "octet 20: DATA_FRAG: it is longer than its fragments"},
        Case{"1601 2400 0000 1c00 " + kToUser + "02000000 0100 0800 010000ff 01020304",
             "octet 20: DATA_FRAG: its sample is too large"},
        Case{"1601 2400 0000 1000 " + kToUser + "02000000 0100 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: its inline QoS begins within its header"},
        Case{"1601 2400 0000 1c00 " + kSpdp + "02000000 0100 0800 0c000000 01020304",
             "octet 20: DATA_FRAG: discovery comes in fragments"}));

INSTANTIATE_TEST_SUITE_P(
    Discovery, Judged,
    testing::Values(
        Case{"1505 2000 0000 1000 " + kSpdp + "00030000 00000000 01000000", ""},
        Case{"1505 2000 0000 1000 " + kSpdp + "00010000 00000000 01000000",
             "octet 20: DATA: discovery is no list of parameters"},
        Case{"1505 1c00 0000 1000 " + kSpdp + "00030000 00000000",
             "octet 20: DATA: a list of parameters has no end"},
        // An entity's name of 0xffffffff octets, then one without an end, and a good one.
        Case{"1505 2800 0000 1000 " + kSpdp + "00030000 62000800 ffffffff 61000000 01000000",
             "octet 20: DATA: a string goes beyond its parameter, or has no end"},
        Case{"1505 2800 0000 1000 " + kSpdp + "00030000 62000800 01000000 61000000 01000000",
             "octet 20: DATA: a string goes beyond its parameter, or has no end"},
        Case{"1505 2800 0000 1000 " + kSpdp + "00030000 62000800 02000000 61000000 01000000", ""},
        // The same in big endian within a DATA in little endian.
        Case{"1505 2800 0000 1000 " + kSpdp + "00020000 00620008 00000002 61000000 00010000", ""},
        Case{"1505 2800 0000 1000 " + kSpdp + "00030000 2c000800 05000000 61000000 01000000",
             "octet 20: DATA: a sequence of octets goes beyond its parameter"},
        Case{"1505 2400 0000 1000 " + kSpdp + "00030000 59000400 ffffffff 01000000",
             "octet 20: DATA: a list of properties goes beyond its parameter"},
        Case{"1505 3800 0000 1000 " + kSpdp +
                 "00030000 32001800 01000000 f21c0000 00000000000000000000000 07f000001 01000000",
             ""},
        Case{"1505 3800 0000 1000 " + kSpdp +
                 "00030000 32001800 20000000 f21c0000 000000000000000000000000 7f000001 01000000",
             "octet 20: DATA: a locator is of an unknown kind"},
        Case{"1505 2400 0000 1000 " + kSpdp + "00030000 50000400 00000000 01000000",
             "octet 20: DATA: a GUID has not 16 octets"},
        Case{"1505 1c00 0000 1000 000200c7 000200c2 00000000 01000000 00010000 00000000",
             "octet 20: DATA: a participant message is too short"}));

INSTANTIATE_TEST_SUITE_P(
    Heartbeat, Judged,
    testing::Values(Case{"0701 1c00 00000107 00000102 00000000 01000000 00000000 00000000 01000000",
                         ""},
                    Case{"0701 1800 00000107 00000102 00000000 01000000 00000000 00000000",
                         "octet 20: HEARTBEAT: it is too short"},
                    Case{"0701 1c00 00000107 00000102 00000000 00000000 00000000 00000000 01000000",
                         "octet 20: HEARTBEAT: its first sequence number is below 1"},
                    Case{"0701 1c00 00000107 00000102 00000000 05000000 00000000 03000000 01000000",
                         "octet 20: HEARTBEAT: its last sequence number is before its first"},
                    Case{"0701 1c00 00000107 00000102 00000000 05000000 ffffff7f ffffffff 01000000",
                         "octet 20: HEARTBEAT: its last sequence number is no number"},
                    Case{"0709 1c00 00000107 00000102 00000000 01000000 00000000 00000000 01000000",
                         "octet 20: HEARTBEAT: it is too short"}));

INSTANTIATE_TEST_SUITE_P(
    Sets, Judged,
    testing::Values(
        Case{"0601 1c00 00000107 00000102 00000000 01000000 20000000 ffffffff 01000000", ""},
        Case{"0601 1800 00000107 00000102 00000000 00000000 00000000 01000000", ""},
        Case{"0601 1800 00000107 00000102 ffffffff ffffffff 00000000 01000000",
             "octet 20: ACKNACK: a set of sequence numbers begins too low"},
        Case{"0601 1800 00000107 00000102 ffffff7f ffffffff 00000000 01000000",
             "octet 20: ACKNACK: a set of sequence numbers goes beyond the last one there is"},
        Case{"0601 1800 00000107 00000102 00000000 01000000 01010000 01000000",
             "octet 20: ACKNACK: a set of numbers has more than 256 bits"},
        Case{"0601 1800 00000107 00000102 00000000 01000000 40000000 01000000",
             "octet 20: ACKNACK: a set of numbers is cut off"},
        Case{"0601 1400 00000107 00000102 00000000 01000000 00000000",
             "octet 20: ACKNACK: it is too short"},
        Case{"0801 1c00 00000107 00000102 00000000 01000000 00000000 03000000 00000000", ""},
        Case{"0801 1c00 00000107 00000102 00000000 00000000 00000000 03000000 00000000",
             "octet 20: GAP: it starts below 1"},
        Case{"0801 1c00 00000107 00000102 00000000 01000000 00000000 00000000 00000000",
             "octet 20: GAP: a set of sequence numbers begins too low"},
        Case{"0801 1c00 00000107 00000102 00000000 01000000 01000000 00000000 00000000",
             "octet 20: GAP: it is too wide"},
        Case{"1201 1c00 00000107 00000102 00000000 01000000 01000000 00000000 01000000", ""},
        Case{"1201 1c00 00000107 00000102 00000000 01000000 00000000 00000000 01000000",
             "octet 20: NACK_FRAG: a set of fragment numbers begins with 0"},
        Case{"1301 1800 00000107 00000102 00000000 01000000 01000000 01000000", ""},
        Case{"1301 1800 00000107 00000102 00000000 01000000 00000000 01000000",
             "octet 20: HEARTBEAT_FRAG: its last fragment has the number 0"}));

INSTANTIATE_TEST_SUITE_P(
    Interpreters, Judged,
    testing::Values(Case{"0e01 0c00 010f0102030405060708090a", ""},
                    Case{"0e01 0800 010f010203040506", "octet 20: INFO_DST: it is too short"},
                    Case{"0901 0800 0000000000000000", ""}, Case{"0903 0000", ""},
                    Case{"0901 0400 00000000", "octet 20: INFO_TS: it is too short"},
                    Case{"0c01 1400 00000000 0203 010f 010f0102030405060708090b", ""},
                    Case{"0c01 1000 00000000 0203 010f 010f010203040506",
                         "octet 20: INFO_SRC: it is too short"},
                    Case{"0f01 0400 ffffff0f",
                         "octet 20: INFO_REPLY: it is too short for its locators"},
                    Case{"7f01 0400 ffffffff 8001 0400 ffffffff 3001 0400 ffffffff", ""}));

TEST(Relayed, DiscoveryOfOthersIsRefusedWhereEverybodySpeaksForHimself) {
  const std::string guid = "50001000 010f0102030405060708090b 000001c1";
  const Datagram other = datagram("1505 3000 0000 1000 " + kSpdp + "00030000" + guid + "01000000");
  EXPECT_FALSE(fault_in(octets_of(other)));
  const Limits own{.relayed_discovery = false};
  EXPECT_EQ(fault_in(octets_of(other), own)->what,
            "it tells of another participant than the one that sent it");
  // Its own words, and those of another in its mouth.
  const Datagram dispose = datagram("1503 3400 0000 1000 " + kSpdp +
                                    "70001000 010f0102030405060708090b 000001c1"
                                    "71000400 00000003 01000000");
  EXPECT_TRUE(fault_in(octets_of(dispose), own));
  const Datagram source = datagram("0c01 1400 00000000 0203 010f 010f0102030405060708090b");
  EXPECT_EQ(fault_in(octets_of(source), own)->what,
            "it is for another participant than the sender");
}

TEST(HighestSequenceNumber, IsToldAndLimited) {
  const Datagram data = datagram(
      "1505 1c00 0000 1000 00000107 00000102 00000000 64000000 00010000 2a000000"
      "0701 1c00 00000107 00000102 00000000 63000000 00000000 ff000000 01000000");
  std::int64_t highest = 7;
  EXPECT_FALSE(fault_in(octets_of(data), {.sequence_number = 100}, highest));
  EXPECT_EQ(highest, 100);
  EXPECT_EQ(fault_in(octets_of(data), {.sequence_number = 99}, highest)->what,
            "its sequence number is far beyond the last one");
  const Datagram heartbeat =
      datagram("0701 1c00 00000107 00000102 00000000 63000000 00000000 ff000000 01000000");
  EXPECT_EQ(fault_in(octets_of(heartbeat), {.sequence_number = 98}, highest)->what,
            "its first sequence number is far beyond the last one");
}

}  // namespace
}  // namespace hal::rtps
