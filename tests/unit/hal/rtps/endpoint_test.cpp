#include "hal/rtps/endpoint.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "hal/rtps/data.h"
#include "hal/rtps/walk.h"
#include "tests/unit/hal/rtps/datagrams.h"

namespace hal::rtps {
namespace {

/// Topics and types that real programs told of, and how many of them were writers.
std::map<std::string, int> endpoints_of(const std::string& implementation) {
  std::map<std::string, int> found;
  for (const Datagram& datagram : recorded(implementation)) {
    Walk walk(octets_of(datagram));
    while (const Submessage* one = walk.next()) {
      const bool is_sedp =
          one->writer() == kSedpPublicationWriter || one->writer() == kSedpSubscriptionWriter;
      if (one->kind != SubmessageKind::kData || !is_sedp) continue;
      Data data;
      EXPECT_TRUE(judge_data(*one, walk.header().source, {}, data).empty());
      const auto endpoint = read_endpoint(data.payload);
      if (data.status != 0) continue;
      EXPECT_TRUE(endpoint);
      if (!endpoint) continue;
      EXPECT_EQ(endpoint->guid.entity.is_writer(), one->writer() == kSedpPublicationWriter);
      EXPECT_FALSE(endpoint->type.empty());
      found[std::string(endpoint->topic)] += endpoint->guid.entity.is_writer() ? 1 : 0;
    }
  }
  return found;
}

TEST(ReadEndpoint, NamesWhatRealProgramsTellOf) {
  for (const auto* implementation : {"cyclone_dds", "fast_dds"}) {
    const auto found = endpoints_of(implementation);
    EXPECT_GE(found.size(), 2U) << implementation;
    EXPECT_FALSE(found.contains("")) << implementation;
  }
}

TEST(ReadEndpoint, ReadsWhatItIsForInBothEndiannesses) {
  const Datagram little = from_hex(
      "00030000 0500 0800 04000000 61626300 0700 0800 02000000 74000000"
      "5a00 1000 0102030405060708090a0b0c 00000103"
      "1a00 0c00 02000000 00000000 00000000 1d00 0400 01000000 0100 0000");
  const Datagram big = from_hex(
      "00020000 0005 0008 00000004 61626300 0007 0008 00000002 74000000"
      "005a 0010 0102030405060708090a0b0c 00000103"
      "001a 000c 00000002 00000000 00000000 001d 0004 00000001 0001 0000");
  for (const Datagram& payload : {little, big}) {
    const auto endpoint = read_endpoint(octets_of(payload));
    ASSERT_TRUE(endpoint);
    EXPECT_EQ(endpoint->topic, "abc");
    EXPECT_EQ(endpoint->type, "t");
    EXPECT_EQ(endpoint->guid.entity.value, 0x00000103U);
    EXPECT_EQ(std::to_integer<int>(endpoint->guid.prefix.octets[11]), 12);
    EXPECT_EQ(endpoint->reliability, 2U);
    EXPECT_EQ(endpoint->durability, 1U);
  }
}

TEST(ReadEndpoint, SaysNothingOfWhatIsCutOff) {
  const Datagram whole = from_hex(
      "00030000 0500 0800 04000000 61626300 5a00 1000 0102030405060708090a0b0c 00000103 0100 0000");
  ASSERT_TRUE(read_endpoint(octets_of(whole)));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(read_endpoint(octets_of(whole).first(size))) << size;
}

TEST(ReadEndpoint, ReadsDeadlineAndHistoryWhereTheyAreGiven) {
  const std::string begin = "00030000 5a00 1000 0102030405060708090a0b0c 00000103";
  const auto read = [&begin](const std::string& parameters) {
    const Datagram payload = from_hex(begin + parameters + "0100 0000");
    const auto endpoint = read_endpoint(octets_of(payload));
    EXPECT_TRUE(endpoint);
    return endpoint.value_or(DiscoveredEndpoint{});
  };
  EXPECT_FALSE(read("").deadline);
  EXPECT_FALSE(read("").history);
  EXPECT_EQ(read("2300 0800 01000000 00000080").deadline, 1'500'000'000);  // half of 2^32
  EXPECT_FALSE(read("2300 0800 ffffff7f ffffffff").deadline);              // infinite
  EXPECT_FALSE(read("4000 0800 00000000 07000000").history->keeps_all);
  EXPECT_EQ(read("4000 0800 00000000 07000000").history->depth, 7U);
  EXPECT_TRUE(read("4000 0800 01000000 00000000").history->keeps_all);
  EXPECT_FALSE(read("4000 0400 01000000").history);  // too short
}

}  // namespace
}  // namespace hal::rtps
