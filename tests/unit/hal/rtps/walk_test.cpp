#include "hal/rtps/walk.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "tests/unit/hal/rtps/datagrams.h"

namespace hal::rtps {
namespace {

struct Counted {
  std::map<std::string, int> by_name;
  std::size_t octets = Header::kSize;
  int builtin = 0, user = 0;
};

/// What a ledger of air time needs of a datagram.
Counted count(const std::vector<Datagram>& datagrams) {
  Counted counted;
  for (const Datagram& one : datagrams) {
    Walk walk(octets_of(one));
    std::size_t octets = Header::kSize;
    while (const Submessage* submessage = walk.next()) {
      ++counted.by_name[std::string(name_of(submessage->kind))];
      octets += submessage->size();
      if (!submessage->has_endpoints()) continue;
      ++(submessage->writer().is_builtin() ? counted.builtin : counted.user);
    }
    EXPECT_FALSE(walk.fault()) << walk.fault()->text();
    EXPECT_EQ(octets, one.size());
  }
  return counted;
}

TEST(Walk, NamesEverySubmessageOfRealDatagramsAndMissesNoOctet) {
  // Counted by another program: submessages() of tests/e2e/garbage.py.
  const Counted fast = count(recorded("fast_dds"));
  EXPECT_EQ(fast.by_name, (std::map<std::string, int>{{"ACKNACK", 16},
                                                      {"DATA", 60},
                                                      {"HEARTBEAT", 32},
                                                      {"INFO_DST", 50},
                                                      {"INFO_TS", 60},
                                                      {"vendor's", 90}}));
  EXPECT_GT(fast.builtin, 0);
  EXPECT_GT(fast.user, 0);
  const Counted cyclone = count(recorded("cyclone_dds"));
  EXPECT_EQ(cyclone.by_name,
            (std::map<std::string, int>{
                {"ACKNACK", 71}, {"DATA", 7}, {"HEARTBEAT", 5}, {"INFO_DST", 34}, {"INFO_TS", 7}}));
}

TEST(Walk, TellsHeaderKindFlagsPlaceAndEndpoints) {
  const Datagram bytes = datagram(
      "0901 0800 0000000000000000"
      "0703 1c00 000004c7 000004c2 0000000001000000 0000000002000000 01000000");
  Walk walk(octets_of(bytes));
  EXPECT_EQ(walk.header().major, 2);
  EXPECT_EQ(walk.header().minor, 3);
  EXPECT_EQ(walk.header().source.octets[11], std::byte{0x0a});
  const Submessage* one = walk.next();
  ASSERT_NE(one, nullptr);
  EXPECT_EQ(name_of(one->kind), "INFO_TS");
  EXPECT_EQ(one->at, 20);
  EXPECT_FALSE(one->has_endpoints());
  one = walk.next();
  ASSERT_NE(one, nullptr);
  EXPECT_EQ(name_of(one->kind), "HEARTBEAT");
  EXPECT_EQ(one->at, 32);
  EXPECT_TRUE(one->has_flag(1));
  EXPECT_FALSE(one->has_flag(2));
  EXPECT_EQ(name_of(one->reader()), "SEDP subscription reader");
  EXPECT_EQ(name_of(one->writer()), "SEDP subscription writer");
  EXPECT_TRUE(one->writer().is_builtin());
  EXPECT_EQ(walk.next(), nullptr);
  EXPECT_FALSE(walk.fault());
}

TEST(Walk, EndpointsAreReadInTheirOrderWhateverTheEndianness) {
  for (const char* submessage : {"0700 001c 00000107 00000102", "0701 1c00 00000107 00000102"}) {
    const Datagram bytes =
        datagram(submessage + std::string(" 0000000000000001 0000000000000001 00000001"));
    Walk walk(octets_of(bytes));
    const Submessage* one = walk.next();
    ASSERT_NE(one, nullptr);
    EXPECT_EQ(one->reader().value, 0x00000107U);
    EXPECT_EQ(name_of(one->writer()), "user writer");
  }
}

TEST(Walk, LengthZeroGoesToTheEndExceptInPadAndInfoTimestamp) {
  const Datagram bytes = datagram("0101 0000 0903 0000 8001 0000 0102030405");
  Walk walk(octets_of(bytes));
  EXPECT_EQ(walk.next()->body.size(), 0);
  EXPECT_EQ(walk.next()->body.size(), 0);
  const Submessage* last = walk.next();
  EXPECT_EQ(name_of(last->kind), "vendor's");
  EXPECT_EQ(last->body.size(), 5);
  EXPECT_EQ(walk.next(), nullptr);
}

struct Stopped {
  std::string datagram, fault;
};
class StoppedWalk : public testing::TestWithParam<Stopped> {};

TEST_P(StoppedWalk, SaysWhereAndWhy) {
  const Datagram bytes = from_hex(GetParam().datagram);
  Walk walk(octets_of(bytes));
  while (walk.next() != nullptr) {
  }
  ASSERT_TRUE(walk.fault());
  EXPECT_EQ(walk.fault()->text(), GetParam().fault);
}

INSTANTIATE_TEST_SUITE_P(
    Faults, StoppedWalk,
    testing::Values(Stopped{"", "octet 0: header: it is shorter than 20 octets"},
                    Stopped{"52545053 0203 010f 010f01020304050607080a",
                            "octet 0: header: it is shorter than 20 octets"},
                    Stopped{"52545058 0203 010f 010f0102030405060708090a",
                            "octet 0: header: it does not begin with RTPS"},
                    Stopped{"52545053 0303 010f 010f0102030405060708090a",
                            "octet 4: header: its major version is not 2"},
                    Stopped{std::string(kHeader) + "150500",
                            "octet 20: submessage: its header is cut off"},
                    Stopped{std::string(kHeader) + "01010000 01010900 00000000",
                            "octet 24: submessage: it is longer than the datagram"},
                    Stopped{std::string(kHeader) + "01010300 000000 01010000",
                            "octet 20: submessage: the next one is not aligned to 4 octets"}));

}  // namespace
}  // namespace hal::rtps
