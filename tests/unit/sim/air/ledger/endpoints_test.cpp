#include "sim/air/endpoints.h"

#include <gtest/gtest.h>

#include <span>
#include <string>
#include <vector>

#include "hal/types/message.h"

namespace sim::air::test {
namespace {

using hal::AgentId;

/// A sequence of strings as in a parameter list, little-endian.
hal::Bytes sequence(const std::vector<std::string>& names) {
  hal::Bytes bytes;
  const auto word = [&bytes](std::size_t value) {
    for (unsigned shift = 0; shift < 32; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  word(names.size());
  for (const std::string& name : names) {
    word(name.size() + 1);
    bytes.insert(bytes.end(), name.begin(), name.end());
    bytes.push_back(0);
    while (bytes.size() % 4 != 0) bytes.push_back(0);
  }
  return bytes;
}

/// Endpoints that know each other: a writer at agent 1, a reader at agent 2.
class EndpointsTest : public testing::Test {
 protected:
  const Endpoint& learn(std::uint16_t agent, const std::vector<std::string>& partitions) {
    hal::rtps::Guid guid{{}, {agent == 1 ? 0x103U : 0x204U}};
    guid.prefix.octets.fill(static_cast<std::byte>(agent));
    const hal::Bytes bytes = sequence(partitions);
    endpoints.place(guid.prefix, AgentId{agent});
    const EndpointIndex index = endpoints.learn({}, {.guid = guid,
                                                     .topic = "scan",
                                                     .type = "type",
                                                     .partitions = std::as_bytes(std::span(bytes)),
                                                     .endianness = hal::rtps::Endianness::kLittle});
    const AgentId there{static_cast<std::uint16_t>(3 - agent)};
    endpoints.meet(guid.prefix, there);
    endpoints.reach(index, index, there);
    if (agent == 1) writer = index;
    return endpoints.all()[index];
  }
  bool do_match() const { return !endpoints.readers_of(writer).empty(); }

  Endpoints endpoints;
  EndpointIndex writer = 0;
};

TEST_F(EndpointsTest, OfOnePartitionMatch) {
  learn(1, {"a", "b"});
  learn(2, {"c", "b"});
  EXPECT_TRUE(do_match());
  learn(2, {"c"});
  EXPECT_FALSE(do_match());
}

// Whoever sends garbage can give an endpoint names as long as a datagram.
TEST_F(EndpointsTest, NamesOfPartitionsAreCut) {
  const std::string name(60'000, 'a');
  const Endpoint& cut = learn(1, {name, "b"});
  ASSERT_EQ(cut.partitions.size(), 2U);
  EXPECT_EQ(cut.partitions[0], name.substr(0, Endpoints::kLongestName));
  EXPECT_EQ(cut.partitions[1], "b") << "what follows is read all the same";
  learn(2, {name});
  EXPECT_TRUE(do_match());
}

TEST_F(EndpointsTest, OfManyPartitionsTheFirstAreKept) {
  std::vector<std::string> names;
  for (int i = 0; i < 1000; ++i) names.push_back(std::to_string(i));
  const Endpoint& endpoint = learn(1, names);
  names.resize(Endpoints::kMostPartitions);
  EXPECT_EQ(endpoint.partitions, names);
}

}  // namespace
}  // namespace sim::air::test
