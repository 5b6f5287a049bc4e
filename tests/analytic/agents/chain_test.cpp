#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/agents/simulation.h"
#include "tests/support/no_pace.h"
#include "tests/support/printers.h"
#include "tests/support/scripted_port.h"

namespace {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Duration;
using hal::Time;
using hal::node::exchange::Action;
using sim::agents::SimulationConfig;

constexpr int kHops = 8;
constexpr double kSpacing = 200;  // m; the range is 250 m, so a node hears its two neighbours only

AgentId node(int i) { return AgentId{static_cast<std::uint16_t>(i + 1)}; }

/// Nine motes in a row with the radio of the paper.
SimulationConfig chain(std::uint64_t seed) {
  SimulationConfig config;
  config.seed = seed;
  config.control_phase = sim::agents::ControlPhase::kAligned;
  config.radio = sim::radio::profile_defaults(sim::radio::Profile::kMobilityFramework);
  for (int i = 0; i <= kHops; ++i) {
    config.agents.push_back({.id = node(i),
                             .name = "m" + std::to_string(i),
                             .pose = {kSpacing * i, 0, 0},
                             .body = hal::node::devices::MoteDescription{},
                             .program = {},
                             .parameters = {}});
  }
  return config;
}

/// The controller of the first mote: at 10 h seconds it sends a message to the node h hops away,
/// which finds the route, and 5 s later, when all is silent, another one.
std::vector<Action> calls(const hal::node::exchange::Event& event, hal::MessageId& sent) {
  std::vector<Action> actions;
  if (event.agent != node(0) || event.cause() != hal::node::exchange::Cause::kControl)
    return actions;
  for (int h = 1; h <= kHops; ++h) {
    if (event.time != Time{h * 10s} && event.time != Time{h * 10s + 5s}) continue;
    actions.push_back({.what = hal::node::exchange::Send{
                           .id = ++sent, .destination = node(h), .topic = "test", .payload = {}}});
  }
  return actions;
}

/// Delays of messages by destination: the first of each waits for a route, the second does not.
class Delays final : public sim::agents::Observer {
 public:
  void on_message_sent(Time at, const hal::Message& message) override { sent_[message.id] = at; }
  void on_message_delivered(Time at, AgentId receiver, const hal::Message& message, int) override {
    of[receiver].push_back(at - sent_.at(message.id));
  }

  std::map<AgentId, std::vector<Duration>> of;

 private:
  std::map<hal::MessageId, Time> sent_;
};

std::map<AgentId, std::vector<Duration>> delays_of_run(std::uint64_t seed) {
  const SimulationConfig config = chain(seed);
  Delays delays;
  sim::agents::Simulation simulation(config, {&delays});
  std::vector<AgentId> agents;
  for (const auto& agent : config.agents) agents.push_back(agent.id);
  simulation.connect(
      std::make_shared<tests::ScriptedPort>(
          [sent = hal::MessageId{0}](const auto& event) mutable { return calls(event, sent); }),
      agents, {});
  tests::NoPace pace;
  simulation.run(Time{(kHops + 1) * 10s}, pace);
  return delays.of;
}

// 802.11 at 11 Mb/s with RTS/CTS, 272-bit headers, empty packets; each frame to the nearest ns:
// PLCP 192 us + bits / 11 Mb/s: RTS 206545, CTS and ACK 202182, data 216727 ns.
constexpr Duration kDifs = 50us, kSifs = 10us, kSlot = 20us;
constexpr Duration kRts = 206545ns, kCts = 202182ns, kAck = 202182ns, kData = 216727ns;
constexpr Duration kFirstHop = kDifs + kRts + kSifs + kCts + kSifs + kData;
// A relay first acknowledges, then sends after 0..7 slots of backoff: its medium was busy.
constexpr Duration kFurtherHop = kSifs + kAck + kFirstHop;
constexpr Duration kMostBackoff = 7 * kSlot;
// The acknowledgement's end and the start of the next contention are 1 ns apart in the Mobility
// Framework; 10 ns a hop are allowed for that and for rounding.
constexpr Duration kSlackPerHop = 10ns;

static_assert(kFirstHop == 695454ns && kFurtherHop == 907636ns);

TEST(SilentChain, EveryDelayOfOneToEightHopsIsInsideItsBand) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto delays = delays_of_run(seed);
    for (int h = 1; h <= kHops; ++h) {
      ASSERT_EQ(delays.at(node(h)).size(), 2u) << "seed " << seed << ", " << h << " hops";
      const Duration delay = delays.at(node(h))[1];
      const Duration least = kFirstHop + (h - 1) * kFurtherHop;
      EXPECT_GE(delay, least);
      EXPECT_LE(delay, least + (h - 1) * kMostBackoff + h * kSlackPerHop);
    }
  }
}

TEST(SilentChain, BackoffsAreWholeSlots) {
  const auto delays = delays_of_run(3);
  for (int h = 1; h <= kHops; ++h) {
    const Duration over = delays.at(node(h))[1] - kFirstHop - (h - 1) * kFurtherHop;
    EXPECT_LE(over % kSlot, h * kSlackPerHop) << h << " hops";
  }
}

// A neighbour's route is found by a broadcast and the answer to it: 962181 ns.
TEST(SilentChain, TheFirstMessageToANeighbourWaitsForItsRoute) {
  const Duration broadcast = kDifs + kData;
  const auto delays = delays_of_run(1);
  EXPECT_GE(delays.at(node(1))[0], broadcast + kFirstHop + kFirstHop);
}

}  // namespace
