#include "sim/air/ledger.h"

#include <gtest/gtest.h>

#include <numeric>

#include "hal/types/random.h"
#include "sim/air/air_summary.h"
#include "sim/air/latency_histogram.h"
#include "tests/unit/sim/air/ledger/dds_packets.h"

namespace sim::air::test {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;

Piece piece(std::uint32_t octets) { return {.kind = {}, .octets = octets}; }

TEST(ShareOut, GivesWhatIsLeftToTheLargestRemainders) {
  std::vector<std::int64_t> parts;
  share_out(10, std::vector{piece(1), piece(1), piece(1)}, parts);
  EXPECT_EQ(parts, (std::vector<std::int64_t>{4, 3, 3}));
  // 10 x 0.47, 0.16, 0.158, 0.12, 0.061, 0.031: whole parts 4 1 1 1 0 0, the rest to 0.7, 0.61,
  // 0.6.
  share_out(10, std::vector{piece(470), piece(160), piece(158), piece(120), piece(61), piece(31)},
            parts);
  EXPECT_EQ(parts, (std::vector<std::int64_t>{5, 2, 1, 1, 1, 0}));
}

TEST(ShareOut, IsExactWhateverTheNumbersAre) {
  hal::RandomStream random(7, "share out");
  for (int round = 0; round < 1000; ++round) {
    std::vector<Piece> pieces(1 + random.below(40));
    for (Piece& one : pieces) one.octets = static_cast<std::uint32_t>(1 + random.below(65'000));
    const auto whole = static_cast<std::int64_t>(random.below(20'000'000));
    std::vector<std::int64_t> parts;
    share_out(whole, pieces, parts);
    ASSERT_EQ(std::accumulate(parts.begin(), parts.end(), std::int64_t{0}), whole);
    const auto total = std::accumulate(pieces.begin(), pieces.end(), std::int64_t{0},
                                       [](auto sum, const Piece& one) { return sum + one.octets; });
    for (std::size_t i = 0; i < parts.size(); ++i)
      ASSERT_LE(std::abs(parts[i] * total - whole * pieces[i].octets), total) << "less than one";
  }
}

TEST(LatencyHistogram, HasEveryTimeInABinOfAThirtySecondth) {
  for (std::int64_t ns = 0; ns < 1'000'000'000'000; ns += 1 + ns / 7) {
    const auto bin = LatencyHistogram::bin_of(hal::Duration{ns});
    const std::int64_t low = LatencyHistogram::edge(bin).count();
    const std::int64_t high = LatencyHistogram::edge(bin + 1).count();
    ASSERT_LE(low, ns);
    ASSERT_LT(ns, high);
    ASSERT_LE((high - low) * 32, std::max<std::int64_t>(low, 32));
  }
}

TEST(ServicePort, IsTheLowerOneUnlessBothAreOfTheMoment) {
  EXPECT_EQ(service_port(40'000, 5201), 5201);
  EXPECT_EQ(service_port(53, 40'000), 53);
  EXPECT_EQ(service_port(40'000, 32'768), 0);
}

/// What a packet is counted as.
std::vector<Piece> pieces_of(radio::Ethertype type, const hal::Bytes& packet) {
  Endpoints endpoints;
  Contents contents(endpoints);
  return contents.read({}, AgentId{1}, type, std::make_shared<const hal::Bytes>(packet))
      .content->pieces;
}

TEST(Contents, TellsProtocolsAndPortsApart) {
  hal::Bytes packet(40, 0);
  packet[0] = 0x45;
  packet[3] = 40;
  packet[20] = 0x9c;  // 40000
  packet[21] = 0x40;
  packet[23] = 22;
  const auto text = [&packet](std::uint8_t protocol) {
    packet[9] = protocol;
    const AirKind kind = pieces_of(kEthertypeIpv4, packet).front().kind;
    return what_text(kind) + ":" + std::to_string(kind.port);
  };
  EXPECT_EQ(text(1), "ICMP:0");
  EXPECT_EQ(text(2), "IGMP:0");
  EXPECT_EQ(text(6), "TCP:22");
  EXPECT_EQ(text(132), "IP 132:0");
  packet[25] = 20;  // length of the datagram of UDP
  EXPECT_EQ(text(17), "UDP:22");
  packet[25] = 21;  // longer than the packet
  EXPECT_EQ(text(17), "malformed:0");
  packet[7] = 1;  // a later fragment of which nobody saw the first
  EXPECT_EQ(text(17), "fragments:0");
  packet[3] = 41;
  EXPECT_EQ(text(1), "malformed:0");
  EXPECT_EQ(what_text(pieces_of(kEthertypeArp, packet).front().kind), "ARP");
  EXPECT_EQ(what_text(pieces_of(0x1234, packet).front().kind), "0x1234");
}

TEST(Contents, SharesAFrameByTheSubmessagesInIt) {
  const hal::Bytes message =
      Rtps(1).info_destination(2).data(0x103, 1, hal::Bytes(40, 1)).heartbeat(0x103, 1).bytes();
  const auto packet = udp(0s, 1, AgentId{2}, message, 1).front();
  std::string text;
  for (const Piece& one : pieces_of(packet.type, *packet.payload))
    text += std::string(name(one.kind.purpose)) + " " + what_text(one.kind) + " " +
            std::to_string(one.octets) + "; ";
  EXPECT_EQ(text, "user INFO_DST 16; user DATA 64; user HEARTBEAT 32; ");
}

// Each fragment of IP has its share of the submessage that goes through them, which begins in one.
TEST(Contents, FollowsADatagramThroughItsFragments) {
  const hal::Bytes message =
      Rtps(1).data(0x103, 1, hal::Bytes(3000, 1)).heartbeat(0x103, 1).bytes();
  Endpoints endpoints;
  Contents contents(endpoints);
  std::string text;
  std::uint32_t octets = 0;
  for (const Packet& packet : udp(0s, 1, AgentId{2}, message, 1)) {
    for (const Piece& one :
         contents.read({}, AgentId{1}, packet.type, packet.payload).content->pieces) {
      text += what_text(one.kind) + (one.begins ? " begins; " : "; ");
      octets += one.octets;
    }
  }
  EXPECT_EQ(text, "DATA begins; DATA; DATA; HEARTBEAT begins; ");
  EXPECT_EQ(octets, message.size() - 20) << "all but the header of RTPS";
}

TEST(Contents, AreKeptOnlyWhileSomebodyHoldsThePayload) {
  Endpoints endpoints;
  Contents contents(endpoints);
  for (int i = 0; i < 10'000; ++i)
    contents.read({}, AgentId{1}, kEthertypeArp, std::make_shared<const hal::Bytes>(28));
  EXPECT_LE(contents.kept(), 100U);
}

// As by a station that cannot send for long, while the others do.
TEST(Contents, ThatAreHeldForLongKeepNoOthers) {
  Endpoints endpoints;
  Contents contents(endpoints);
  const auto read = [&contents](const radio::Payload& payload) {
    return contents.read({}, AgentId{1}, kEthertypeArp, payload).is_new;
  };
  constexpr std::size_t kHeld = 500;
  std::vector<radio::Payload> held;
  for (std::size_t i = 0; i < kHeld; ++i) {
    held.push_back(std::make_shared<const hal::Bytes>(28));
    read(held.back());
  }
  for (int i = 0; i < 100'000; ++i) read(std::make_shared<const hal::Bytes>(28));
  EXPECT_LE(contents.kept(), 2 * kHeld + 100);
  for (const radio::Payload& payload : held) EXPECT_FALSE(read(payload)) << "it is still known";
  held.clear();
  for (std::size_t i = 0; i < 2 * kHeld; ++i) read(std::make_shared<const hal::Bytes>(28));
  EXPECT_LE(contents.kept(), 100U);
}

TEST(AirAccounts, KeepWhatEndedAtEachReceiverHoweverLargeItsAddress) {
  AirAccounts accounts;
  const Content content{.pieces = {piece(10)}};
  AirAccounts::Shares shares;
  accounts.open(content, AgentId{1}, shares);
  for (const int receiver : {65'000, 3, 65'000, 2})
    accounts.add_end(content, shares, AgentId{static_cast<std::uint16_t>(receiver)}, true,
                     hal::Verdict::kDelivered);
  std::string text;
  for (const auto& at : accounts.all()[0].at) {
    const AirEnds& end = at->ends[1][static_cast<std::size_t>(hal::Verdict::kDelivered)];
    text += std::to_string(at->receiver.value) + ": " + std::to_string(end.frames) + "; ";
  }
  EXPECT_EQ(text, "65000: 2; 3: 1; 2: 1; ") << "and no room for others";
}

std::size_t below(hal::RandomStream& random, std::size_t bound) {
  return random.below(static_cast<std::uint32_t>(bound));
}

// Whatever comes, it is counted, and nothing grows without bound.
TEST(Ledger, StandsGarbage) {
  Ledger ledger;
  hal::RandomStream random(3, "garbage");
  const auto captured = read_capture("cyclone_v4");
  radio::Frame frame;
  frame.transmitter = AgentId{1};
  frame.receiver = hal::kEveryone;
  frame.air_length = 1000;
  frame.airtime = 100us;
  constexpr std::uint64_t kFrames = 20'000;
  for (std::uint64_t i = 1; i <= kFrames; ++i) {
    const Packet& like = captured[below(random, captured.size())];
    hal::Bytes bytes = *like.payload;
    for (std::uint64_t change = random.below(8); change > 0; --change)
      bytes[below(random, bytes.size())] = static_cast<std::uint8_t>(random.below(256));
    if (random.below(4) == 0) bytes.resize(below(random, bytes.size()));
    frame.payload = std::make_shared<const hal::Bytes>(bytes);
    frame.ethertype = like.type;
    frame.id = i;
    const hal::Time at{std::chrono::milliseconds{i}};
    ledger.on_entered(
        at, AgentId{1},
        {.destination = hal::kEveryone, .ethertype = like.type, .payload = frame.payload});
    ledger.on_frame_start(at, frame);
    ledger.on_reception(at, frame, AgentId{2}, hal::Verdict::kDelivered, -50);
    ledger.on_left(at, AgentId{2},
                   {.source = AgentId{1},
                    .destination = hal::kEveryone,
                    .payload = frame.payload,
                    .ethertype = like.type});
  }
  ledger.finish(hal::Time{1h});
  std::uint64_t frames = 0;
  hal::Duration airtime{};
  for (const KindUse& one : kinds_of(ledger)) {
    frames += one.frames;
    airtime += one.airtime;
  }
  EXPECT_EQ(frames, kFrames);
  EXPECT_EQ(airtime, kFrames * 100us);
}

}  // namespace
}  // namespace sim::air::test
