#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal/node/routing/router.h"
#include "tests/support/fake_clock.h"

namespace hal::node::routing::test {

using namespace std::chrono_literals;

using Clock = tests::FakeClock;

/// What a link did with one frame.
struct SentFrame {
  Time at;
  AgentId from;
  AgentId to;
  Bytes bytes;
  Priority priority{};
};

struct FateRecord {
  Time at;
  MessageId id;
  Fate fate;
};
struct EndRecord {
  Time at;
  AgentId node;
  AgentId sent_by;
  MessageId id;
  Verdict verdict;
};
struct DiscoveryRecord {
  AgentId destination;
  Duration took;
  bool found;
};

class Network;

/// One router, everything around it, and a record of what it said.
class TestNode final : public Link, public Application, public RoutingObserver {
 public:
  TestNode(Network& network, AgentId self, const RoutingConfig& config, std::uint64_t seed);

  LinkCapabilities capabilities() const override;
  void transmit(AgentId next_hop, Bytes frame, const LinkOptions& options) override;
  Duration expected_delay() const override;
  double transmit_energy(std::size_t) const override;

  void on_message(Message message, int transmissions) override {
    messages.push_back(std::move(message));
    transmissions_of.push_back(transmissions);
  }
  void on_fate(MessageId id, Fate fate) override;
  void on_route_change(const RouteChange& change) override { changes.push_back(change); }
  void on_neighbour(const Neighbour& neighbour) override { heard.push_back(neighbour); }
  void on_neighbour_lost(AgentId neighbour) override { lost.push_back(neighbour); }
  void on_discovery(std::string_view, AgentId destination, Duration took, bool found) override {
    discoveries.push_back({destination, took, found});
  }
  void on_message_end(AgentId sent_by, MessageId id, std::string_view, Verdict verdict) override;
  void on_protocol_event(ProtocolEvent event) override { ++events[event]; }

  AgentId self;
  std::vector<Message> messages;
  std::vector<int> transmissions_of;  ///< Those messages.
  std::vector<FateRecord> fates;
  std::vector<RouteChange> changes;
  std::vector<Neighbour> heard;
  std::vector<AgentId> lost;
  std::vector<DiscoveryRecord> discoveries;
  std::map<ProtocolEvent, int> events;
  MessageId last_id = 0;
  bool is_sending = false;
  std::unique_ptr<Router> router;

 private:
  Network& network_;
};

/// Nodes 1..n on an exact medium: every frame takes 1 ms and nothing collides.
class Network {
 public:
  static constexpr Duration kHop = 1ms;

  /// What the links can tell.
  static constexpr LinkCapabilities kEverything{.tx_status = true, .rssi = true};
  static constexpr LinkCapabilities kNothing{.tx_status = false, .rssi = false};

  explicit Network(int nodes, RoutingConfig config = {}, std::uint64_t seed = 1,
                   LinkCapabilities capabilities = kEverything);

  void connect(int a, int b);
  void disconnect(int a, int b);
  TestNode& node(int number) { return *nodes_.at(static_cast<std::size_t>(number - 1)); }
  int size() const { return static_cast<int>(nodes_.size()); }

  /// @return the id of the message.
  MessageId send(int from, int to, const std::string& topic = "help", Priority priority = {});
  MessageId flood(int from) { return send(from, kEveryone.value); }
  void run(Duration span) { clock.run_until(clock.now() + span); }

  bool are_connected(AgentId a, AgentId b) const { return edges_.contains({a, b}); }
  void transmit(AgentId from, AgentId to, const Bytes& frame, const LinkOptions& options);

  Clock clock;
  const LinkCapabilities capabilities;
  /// Whether this transmission is lost, asked once per receiver. Default: none is.
  std::function<bool(AgentId from, AgentId to)> is_lost = [](AgentId, AgentId) { return false; };
  /// What the link answers instead of trying, e.g. kQueueFull.
  std::function<std::optional<Verdict>(AgentId from)> refusal = [](AgentId) {
    return std::nullopt;
  };
  /// SNR of a reception [dB].
  std::function<double(AgentId from, AgentId to)> snr_db = [](AgentId, AgentId) { return 30.0; };
  /// What the link of a node says of a frame sent now [s, J].
  std::function<Duration(AgentId node)> delay_of = [](AgentId) { return Duration{1ms}; };
  std::function<double(AgentId node)> energy_of = [](AgentId) { return 0.5; };
  std::vector<SentFrame> sent;
  std::vector<EndRecord> ends;

 private:
  void report(AgentId sender, LinkTag tag, Verdict verdict, Duration after);
  void arrive(AgentId from, AgentId to, const Bytes& frame);

  std::vector<std::unique_ptr<TestNode>> nodes_;
  std::set<std::pair<AgentId, AgentId>> edges_;
};

inline AgentId id(int number) { return AgentId{static_cast<std::uint16_t>(number)}; }

/// 1 - 2 - … - n.
void connect_chain(Network& network);
/// Node 1 + column + width * row, joined to those left, right, above and below.
void connect_grid(Network& network, int width);

}  // namespace hal::node::routing::test
