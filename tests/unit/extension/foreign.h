#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal/node/routing/byte_order.h"
#include "hal/node/routing/protocol.h"
#include "sim/radio/channel/path_loss.h"
#include "sim/radio/mac/mac_parts.h"
#include "sim/radio/mac/mobility_framework_mac.h"
#include "sim/radio/radio_config.h"

/// What docs/extending.md says how to add, from outside the simulator: a law of propagation, a
/// radio profile and a routing protocol that only tests have.
namespace tests {

/// Received power: that sent over the distance in metres, less 60 dB.
class TestLaw final : public sim::radio::PathLoss {
 public:
  hal::Milliwatts after(hal::Milliwatts power, const sim::radio::Path& path) const override {
    return 1e-6 / std::max(1.0, std::sqrt(path.distance_squared)) * power;
  }
  double reach(hal::Milliwatts power, hal::Milliwatts least) const override {
    return 1e-6 * power.value / least.value;
  }
};

/// Half of the power at any time.
class TestFading final : public sim::radio::PathLoss {
 public:
  hal::Milliwatts after(hal::Milliwatts power, const sim::radio::Path&) const override {
    return 0.5 * power;
  }
  double reach(hal::Milliwatts, hal::Milliwatts) const override {
    return std::numeric_limits<double>::infinity();
  }
  bool changes_in_time() const override { return true; }
};

template <class Law>
std::unique_ptr<const sim::radio::PathLoss> make_law(const sim::radio::PropagationConfig&) {
  return std::make_unique<Law>();
}

inline const sim::radio::ForeignLawConfig kTestLaw{.model = "test_law",
                                                   .kind = sim::radio::PathLossKind::kLawOfDistance,
                                                   .make = make_law<TestLaw>};
inline const sim::radio::ForeignLawConfig kTestFading{.model = "test_fading",
                                                      .kind = sim::radio::PathLossKind::kFading,
                                                      .make = make_law<TestFading>};

/// The MAC of another profile under a name of its own.
inline std::unique_ptr<sim::radio::MacBase> make_test_mac(const sim::radio::MacParts& parts) {
  static const sim::radio::MobilityFrameworkConfig values;
  return std::make_unique<sim::radio::MobilityFrameworkMac>(parts.context, values, parts.radio,
                                                            parts.backoff);
}

inline sim::radio::ForeignProfileConfig test_profile() {
  sim::radio::ForeignProfileConfig config;
  config.profile = "test_profile";
  config.make_mac = make_test_mac;
  return config;
}

/// One hop, in bytes that no other protocol knows: a message, or a call before the first one.
class TestProtocol final : public hal::node::routing::Protocol {
 public:
  static constexpr std::uint8_t kMessage = 0xE1, kCall = 0xE2;
  static constexpr double kWeightOfHop = 7;

  TestProtocol(hal::AgentId self, const hal::node::routing::RoutingConfig&,
               const hal::node::routing::RouterStreams&,
               const hal::node::routing::RouterPorts& ports)
      : self_(self), ports_(ports) {}

  void send(const hal::Message& message) override {
    if (routes_.empty()) ports_.link.transmit(hal::kEveryone, {kCall}, 0);
    const hal::Route route{message.topic, message.destination, message.destination, {.hops = 1}};
    routes_.push_back(route);
    ports_.observer.on_route_change({route, false});
    hal::node::routing::ByteWriter out;
    out.u8(kMessage);
    out.u32(message.id);
    out.bytes({message.topic.begin(), message.topic.end()});
    ports_.link.transmit(message.destination, out.take(), message.id);
  }
  void invalidate(std::string_view, hal::AgentId) override {}
  std::vector<hal::Route> routes(std::string_view, hal::AgentId) const override { return routes_; }
  std::vector<hal::Route> routes() const override { return routes_; }
  std::vector<hal::Neighbour> neighbours() const override { return {}; }

  bool on_frame(const hal::node::routing::Reception& reception,
                std::span<const std::uint8_t> bytes) override {
    const auto id = id_in(bytes);
    if (!id) return !bytes.empty() && bytes.front() == kCall;
    ports_.application.on_message({.source = reception.from,
                                   .destination = self_,
                                   .id = *id,
                                   .topic = std::string(bytes.begin() + 5, bytes.end()),
                                   .payload = {}},
                                  1);
    return true;
  }
  void on_transmitted(const hal::node::routing::Transmission& transmission) override {
    if (transmission.tag == 0) return;
    ports_.application.on_fate(static_cast<hal::MessageId>(transmission.tag),
                               transmission.verdict == hal::Verdict::kDelivered
                                   ? hal::Fate::kHandedOver
                                   : hal::Fate::kFailed);
  }

  static std::optional<hal::MessageId> id_in(std::span<const std::uint8_t> bytes) {
    hal::node::routing::ByteReader in(bytes);
    if (bytes.size() < 5 || in.u8() != kMessage) return std::nullopt;
    return in.u32();
  }

 private:
  hal::AgentId self_;
  hal::node::routing::RouterPorts ports_;
  std::vector<hal::Route> routes_;
};

inline constinit const hal::node::routing::ProtocolKind kTestProtocol{
    .name = "test_protocol",
    .make = hal::node::routing::make_as<TestProtocol>,
    .name_frame = [](const hal::node::routing::SentFrame& frame) -> hal::node::routing::FrameName {
      if (const auto id = TestProtocol::id_in(frame.bytes)) {
        return {"test message", hal::node::routing::FrameName::MessageName{frame.from, *id}};
      }
      return {frame.bytes.front() == TestProtocol::kCall ? "test call" : ""};
    },
    .weigh = [](const hal::node::routing::RoutingConfig&, const hal::Route& route)
        -> std::optional<double> { return TestProtocol::kWeightOfHop * route.path.hops; }};

}  // namespace tests
