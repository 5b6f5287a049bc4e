#include <gtest/gtest.h>

#include <initializer_list>
#include <set>

#include "sim/radio/mac/flow_hash.h"
#include "sim/radio/mac/fq_codel.h"
#include "sim/radio/mac/station_schedule.h"

namespace sim::radio::test {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kBig = 1000;  // bytes

WaitingMsdu waiting_msdu(std::uint16_t destination, std::size_t bytes = kBig,
                         hal::Duration since = {}, std::uint64_t tag = 0) {
  return {.request = {.destination = hal::AgentId{destination},
                      .payload = std::make_shared<const hal::Bytes>(bytes),
                      .tag = tag},
          .source = hal::AgentId{1},
          .since = hal::Time{} + since};
}

/// IETF RFC 791 and 768: header of 20 bytes, then ports.
WaitingMsdu udp_msdu(std::uint8_t host, std::uint16_t port, bool is_fragment = false) {
  hal::Bytes packet(kBig);
  packet[0] = 0x45;
  if (is_fragment) packet[6] = 0x20;
  packet[9] = 17;
  packet[15] = 1;
  packet[19] = host;
  packet[22] = static_cast<std::uint8_t>(port >> 8);
  packet[23] = static_cast<std::uint8_t>(port);
  packet[900] = static_cast<std::uint8_t>(port);  // of the payload, which must not count
  WaitingMsdu msdu = waiting_msdu(2);
  msdu.request.ethertype = 0x0800;
  msdu.request.payload = std::make_shared<const hal::Bytes>(std::move(packet));
  return msdu;
}

TEST(FifoQueue, TakesSoManyFramesAndBytes) {
  FifoQueue queue({.frames = 3, .bytes = 2500});
  DroppedMsdus dropped;
  EXPECT_TRUE(queue.accepts(waiting_msdu(2, 2500)));
  EXPECT_FALSE(queue.accepts(waiting_msdu(2, 2501)));
  queue.push(waiting_msdu(2, 2000), dropped);
  EXPECT_FALSE(queue.accepts(waiting_msdu(2, 501)));
  queue.push(waiting_msdu(2, 100), dropped);
  queue.push(waiting_msdu(2, 100), dropped);
  EXPECT_FALSE(queue.accepts(waiting_msdu(2, 100))) << "three frames";
  EXPECT_EQ(queue.bytes(), 2200u);
  EXPECT_EQ(queue.pop({}, dropped)->bytes(), 2000u);
  EXPECT_TRUE(queue.accepts(waiting_msdu(2, 2300)));
  EXPECT_TRUE(dropped.empty());
}

TEST(FifoQueue, ForgetsWhatIsTooOld) {
  FifoQueue queue({.frames = 10});
  DroppedMsdus dropped;
  for (const auto since : {1ms, 2ms, 3ms}) queue.push(waiting_msdu(2, kBig, since), dropped);
  queue.expire(hal::Time{} + 3ms, dropped);
  ASSERT_EQ(dropped.size(), 2u);
  EXPECT_EQ(dropped[1].verdict, hal::Verdict::kExpired);
  EXPECT_EQ(queue.frames(), 1u);
}

/// A queue that came all at once at time 0, from which a test takes frames.
class CodelTest : public testing::Test {
 protected:
  CodelTest() : codel(config) { fill(0ms); }
  void fill(hal::Duration since) {
    for (int i = 0; i < 100; ++i) queue.push(waiting_msdu(2, kBig, since));
  }
  /// How many are dropped before the one that leaves at this time.
  std::size_t drops_at(hal::Duration time) {
    DroppedMsdus dropped;
    EXPECT_TRUE(codel.pop(queue, hal::Time{} + time, dropped));
    for (const DroppedMsdu& one : dropped) EXPECT_EQ(one.verdict, hal::Verdict::kQueueDelay);
    return dropped.size();
  }

  FqCodelConfig config{};  // 5 ms, 100 ms
  FlowQueue queue;
  Codel codel;
};

// RFC 8289, 5.3 to 5.6: the delay is too long from 5 ms on, for an interval at 105 ms; then
// 100 ms / sqrt(1), sqrt(2) = 1.414213562373, sqrt(3) = 1.732050807569, sqrt(4) after each drop:
// 70.710678118 ms, 57.735026919 ms, 50 ms.
TEST_F(CodelTest, DropsAtTheTimesOfTheControlLaw) {
  EXPECT_EQ(drops_at(5ms - 1ns), 0u) << "not yet too long";
  EXPECT_EQ(drops_at(5ms), 0u);
  for (const hal::Duration time :
       {105'000'000ns, 205'000'000ns, 275'710'678ns, 333'445'704ns, 383'445'704ns}) {
    EXPECT_EQ(drops_at(time - 1ns), 0u) << time.count();
    EXPECT_EQ(drops_at(time), 1u) << time.count();
  }
}

// Late by three drops: it catches up in one go.
TEST_F(CodelTest, DropsAsManyAsWereDue) {
  EXPECT_EQ(drops_at(5ms), 0u);
  EXPECT_EQ(drops_at(105ms), 1u);
  EXPECT_EQ(drops_at(340ms), 3u);
}

// 5.5: dropping ends with a frame that waited less. The next time within 16 intervals it begins at
// the rate that it had: four drops after the first, 100 ms / sqrt(4) to the second.
TEST_F(CodelTest, GoesOnAtTheEarlierRate) {
  drops_at(5ms);
  for (const hal::Duration time :
       {105'000'000ns, 205'000'000ns, 275'710'678ns, 333'445'704ns, 383'445'704ns}) {
    drops_at(time);
  }
  while (queue.bytes() > 0) queue.pop();
  fill(390ms);
  EXPECT_EQ(drops_at(391ms), 0u) << "the delay is short";
  EXPECT_EQ(drops_at(395ms), 0u);
  EXPECT_EQ(drops_at(495ms), 1u);
  EXPECT_EQ(drops_at(545ms - 1ns), 0u);
  EXPECT_EQ(drops_at(545ms), 1u);
}

TEST_F(CodelTest, ForgetsTheRateAfterSixteenIntervals) {
  drops_at(5ms);
  for (const hal::Duration time : {105'000'000ns, 205'000'000ns, 275'710'678ns}) drops_at(time);
  while (queue.bytes() > 0) queue.pop();
  fill(3s);
  EXPECT_EQ(drops_at(3s + 1ms), 0u);
  EXPECT_EQ(drops_at(3s + 5ms), 0u);
  EXPECT_EQ(drops_at(3s + 105ms), 1u);
  EXPECT_EQ(drops_at(3s + 205ms - 1ns), 0u);
  EXPECT_EQ(drops_at(3s + 205ms), 1u);
}

// 5.3: never of a queue that has no more than one packet of 1500 bytes.
TEST_F(CodelTest, LeavesTheLastPacketAlone) {
  while (queue.frames() > 3) queue.pop();
  EXPECT_EQ(drops_at(5ms), 0u);
  EXPECT_EQ(drops_at(105ms), 0u) << "one is left after it";
  EXPECT_EQ(queue.bytes(), kBig);
}

/// Destinations of the frames in the order in which they leave.
std::vector<int> order_of(FqCodel& queue, hal::Duration at = {}) {
  std::vector<int> order;
  DroppedMsdus dropped;
  while (const auto next = queue.pop(hal::Time{} + at, dropped)) {
    order.push_back(next->request.destination.value);
  }
  return order;
}

// RFC 8290, 4.2: new flows first; then each in turn has 300 bytes: of 1000, 300 and 100 bytes.
TEST(FqCodel, FlowsTakeTurnsByBytes) {
  const FqCodelConfig config{.flows = 65'536};
  FqCodel queue(config, {.frames = 100}, 1);
  DroppedMsdus dropped;
  for (int i = 0; i < 3; ++i) queue.push(waiting_msdu(2, 600), dropped);
  for (int i = 0; i < 6; ++i) queue.push(waiting_msdu(3, 300), dropped);
  EXPECT_EQ(queue.bytes(), 3600u);
  // 2 sends 600 and owes 300, 3 sends 300 and has none left: both are old. Each turn adds 300.
  EXPECT_EQ(order_of(queue), (std::vector{2, 3, 3, 2, 3, 3, 2, 3, 3}));
  EXPECT_EQ(queue.frames(), 0u);
  EXPECT_EQ(queue.bytes(), 0u);
}

TEST(FqCodel, HasALongerTurnWithALargerQuantum) {
  const FqCodelConfig config{.quantum = 1200, .flows = 65'536};
  FqCodel queue(config, {.frames = 100}, 1);
  DroppedMsdus dropped;
  for (int i = 0; i < 3; ++i) queue.push(waiting_msdu(2, 600), dropped);
  for (int i = 0; i < 6; ++i) queue.push(waiting_msdu(3, 300), dropped);
  EXPECT_EQ(order_of(queue), (std::vector{2, 2, 3, 3, 3, 3, 2, 3, 3}));
}

TEST(FqCodel, NewFlowsComeFirst) {
  const FqCodelConfig config{.flows = 65'536};
  FqCodel queue(config, {.frames = 100}, 1);
  DroppedMsdus dropped;
  for (int i = 0; i < 5; ++i) queue.push(waiting_msdu(2), dropped);
  EXPECT_EQ(queue.pop({}, dropped)->request.destination.value, 2);
  queue.push(waiting_msdu(3, 100), dropped);
  EXPECT_EQ(order_of(queue), (std::vector{3, 2, 2, 2, 2}));
}

// 4.1.3: the oldest half of the flow with most bytes.
TEST(FqCodel, DropsOfTheFattestFlow) {
  const FqCodelConfig config{.flows = 65'536};
  FqCodel queue(config, {.frames = 10}, 1);
  DroppedMsdus dropped;
  for (std::uint64_t i = 0; i < 6; ++i) queue.push(waiting_msdu(2, 1000, {}, i), dropped);
  for (std::uint64_t i = 0; i < 5; ++i) queue.push(waiting_msdu(3, 200, {}, 10 + i), dropped);
  ASSERT_EQ(dropped.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(dropped[i].waiting.request.tag, i);
    EXPECT_EQ(dropped[i].verdict, hal::Verdict::kQueueFull);
  }
  EXPECT_EQ(queue.frames(), 8u);
  EXPECT_EQ(queue.bytes(), 4000u);
}

TEST(FqCodel, KeepsALimitOfBytes) {
  const FqCodelConfig config{};
  FqCodel queue(config, {.frames = 1000, .bytes = 2500}, 1);
  DroppedMsdus dropped;
  for (int i = 0; i < 3; ++i) queue.push(waiting_msdu(2), dropped);
  EXPECT_EQ(dropped.size(), 1u);
  EXPECT_EQ(queue.bytes(), 2000u);
  EXPECT_FALSE(queue.accepts(waiting_msdu(2, 2501)));
}

TEST(FqCodel, CountsWhatCodelDrops) {
  const FqCodelConfig config{};
  FqCodel queue(config, {.frames = 1000}, 1);
  DroppedMsdus dropped;
  for (int i = 0; i < 50; ++i) queue.push(waiting_msdu(2), dropped);
  for (const auto at : {5ms, 105ms}) queue.pop(hal::Time{} + at, dropped);
  EXPECT_EQ(dropped.size(), 1u);
  EXPECT_EQ(queue.frames(), 47u);
  EXPECT_EQ(queue.bytes(), 47 * kBig);
}

TEST(FlowHash, TellsPacketsApartByTheirFiveTuple) {
  std::set<std::uint64_t> hashes;
  for (const std::uint16_t port : std::initializer_list<std::uint16_t>{1, 2, 256}) {
    for (const std::uint8_t host : std::initializer_list<std::uint8_t>{1, 2})
      hashes.insert(flow_hash(udp_msdu(host, port), 7));
  }
  EXPECT_EQ(hashes.size(), 6u);
  WaitingMsdu relayed = udp_msdu(1, 1);
  relayed.source = hal::AgentId{9};
  EXPECT_EQ(flow_hash(relayed, 7), flow_hash(udp_msdu(1, 1), 7)) << "whoever sends it";
  EXPECT_NE(flow_hash(udp_msdu(1, 1), 8), flow_hash(udp_msdu(1, 1), 7)) << "another seed";
  EXPECT_EQ(flow_hash(udp_msdu(1, 1, true), 7), flow_hash(udp_msdu(1, 2, true), 7))
      << "fragments: the later ones have no ports";
}

TEST(FlowHash, OfOtherFramesIsOfTheirAddresses) {
  WaitingMsdu other = waiting_msdu(2, 10);
  EXPECT_EQ(flow_hash(other, 7), flow_hash(waiting_msdu(2), 7));
  EXPECT_NE(flow_hash(other, 7), flow_hash(waiting_msdu(3), 7));
  other.source = hal::AgentId{5};
  EXPECT_NE(flow_hash(other, 7), flow_hash(waiting_msdu(2), 7));
}

// 64 flows in 1024 queues: 64 - 64^2 / 2048 = 62 different ones are to be expected.
TEST(FlowHash, SpreadsFlows) {
  std::set<std::uint64_t> queues;
  for (std::uint16_t i = 0; i < 64; ++i) {
    queues.insert((flow_hash(udp_msdu(1, i), 3) >> 32) * 1024 >> 32);
  }
  EXPECT_GE(queues.size(), 57u);
}

constexpr auto kAlways = [](hal::AgentId) { return true; };

TEST(StationSchedule, TakesReceiversInTurn) {
  StationSchedule schedule(std::nullopt);
  for (const std::uint16_t one : std::initializer_list<std::uint16_t>{2, 3, 4})
    schedule.add(hal::AgentId{one});
  std::vector<int> order;
  for (int i = 0; i < 6; ++i) {
    const hal::AgentId receiver = *schedule.next(kAlways);
    order.push_back(receiver.value);
    schedule.charge(receiver, receiver.value == 2 ? 5ms : 1us);
  }
  EXPECT_EQ(order, (std::vector{2, 3, 4, 2, 3, 4}));
}

// The paper's algorithm 3, by hand, quantum 300 us. 2 owes 600 us after its first exchange.
TEST(StationSchedule, SharesAirtime) {
  StationSchedule schedule(300us);
  for (const std::uint16_t one : std::initializer_list<std::uint16_t>{2, 3})
    schedule.add(hal::AgentId{one});
  std::map<int, hal::Duration> airtime;
  for (int i = 0; i < 1000; ++i) {
    const hal::AgentId receiver = *schedule.next(kAlways);
    const hal::Duration took = receiver.value == 2 ? 1000us : 100us;
    schedule.charge(receiver, took);
    airtime[receiver.value] += took;
  }
  EXPECT_NEAR(static_cast<double>(airtime[2].count()), static_cast<double>(airtime[3].count()),
              1e6);  // ns: one exchange
}

// 4: who had nothing to be sent before comes next.
TEST(StationSchedule, ServesSparseReceiversFirst) {
  StationSchedule schedule(300us);
  schedule.add(hal::AgentId{2});
  for (int i = 0; i < 5; ++i) schedule.charge(*schedule.next(kAlways), 500us);
  schedule.add(hal::AgentId{3});
  EXPECT_EQ(schedule.next(kAlways)->value, 3);
  const auto only_2 = [](hal::AgentId one) { return one.value == 2; };
  EXPECT_EQ(schedule.next(only_2)->value, 2);
  EXPECT_EQ(schedule.next([](hal::AgentId) { return false; }), std::nullopt);
}

}  // namespace
}  // namespace sim::radio::test
