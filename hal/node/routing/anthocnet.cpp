#include "hal/node/routing/anthocnet.h"

#include <array>
#include <utility>
#include <variant>

#include "hal/node/routing/frame_name.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

/// Checks all parameters except those of the layer below.
bool is_valid_for_anthocnet(const RoutingConfig& config) {
  return is_valid(config.anthocnet) && config.retry_period > Duration::zero() &&
         config.retry_jitter >= 0 && config.retry_jitter <= 1 && config.retries >= 1 &&
         config.buffer_age > Duration::zero();
}

RouterPorts over(Link& link, const RouterPorts& ports) {
  return {link, ports.timers, ports.application, ports.observer};
}

}  // namespace

AntHocNet::AntHocNet(AgentId self, const RoutingConfig& config, const RouterStreams& streams,
                     const RouterPorts& ports)
    : mac_time_(ports.link, ports.timers, config.anthocnet.mac_weight, config.anthocnet.hop_time),
      hops_(self, config, streams, over(mac_time_, ports), *this),
      table_(ports.observer),
      diffusion_(node_, ports.link.capabilities().tx_status, mac_time_,
                 [this](AgentId neighbour) { hops_.give_up(neighbour); }) {
  BARAKA_CHECK(is_valid_for_anthocnet(config));
  diffusion_.start();
}

void AntHocNet::send(const Message& message) {
  if (is_broadcast(message.destination)) {
    flooding_.send(message);
  } else {
    forwarding_.send(message);
  }
}

void AntHocNet::invalidate(std::string_view topic, AgentId destination) {
  table_.remove({std::string(topic), destination});
}

std::vector<Route> AntHocNet::routes(std::string_view topic, AgentId destination) const {
  return table_.routes(topic, destination);
}

bool AntHocNet::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  return hops_.on_frame(reception, bytes);
}

void AntHocNet::on_transmitted(const Transmission& transmission) {
  mac_time_.on_transmitted(transmission);
  hops_.on_transmitted(transmission);
}

void AntHocNet::on_no_answer(AgentId neighbour) {
  diffusion_.forget(neighbour);
  losses_.on_link_lost(neighbour);
}

void AntHocNet::on_sent(Transit transit, Verdict verdict) {
  if (is_broadcast(transit.data.header.destination)) {
    flooding_.on_sent(transit, verdict);
  } else {
    forwarding_.on_sent(std::move(transit), verdict);
  }
}

void AntHocNet::on_home(const anthocnet::Target& target, anthocnet::AntKind kind,
                        Sequence sequence) {
  if (kind == anthocnet::AntKind::kReactive) setup_.on_home(target, sequence);
}

void AntHocNet::on_trail(const anthocnet::Target& target) {
  repair_.on_trail(target);
  forwarding_.on_trail(target);
}

bool AntHocNet::on_packet(Packet packet, const Arrival& arrival) {
  diffusion_.on_heard(arrival.reception.from);
  return std::visit([&](auto& kind) { return take(std::move(kind), arrival); }, packet);
}

bool AntHocNet::take(Data data, const Arrival& arrival) {
  if (is_broadcast(data.header.destination)) {
    flooding_.on_data(std::move(data));
  } else {
    forwarding_.on_data(std::move(data), arrival.reception.from);
  }
  return true;
}

bool AntHocNet::take(const Control& control, const Arrival& arrival) {
  if (control.protocol != ControlOf::kAntHocNet) return true;  // of another protocol
  auto packet = anthocnet::parse_control(control.body);
  if (!packet) return false;
  return std::visit([&](auto& kind) { return take(std::move(kind), arrival); }, *packet);
}

bool AntHocNet::take(anthocnet::ForwardAnt ant, const Arrival& arrival) {
  return ants_.on_forward_ant(std::move(ant), arrival);
}

bool AntHocNet::take(anthocnet::BackwardAnt ant, const Arrival& arrival) {
  return ants_.on_backward_ant(std::move(ant), arrival);
}

bool AntHocNet::take(const anthocnet::PheromoneHello& hello, const Arrival& arrival) {
  diffusion_.on_hello(hello, arrival);
  return true;
}

bool AntHocNet::take(const anthocnet::LossNotice& notice, const Arrival& arrival) {
  losses_.on_notice(notice, arrival);
  return true;
}

bool AntHocNet::take(const anthocnet::Warning& warning, const Arrival& arrival) {
  losses_.on_warning(warning, arrival.reception.from);
  return true;
}

constexpr std::array kAntHocNetEvents{ProtocolEvent::kHelloSent,
                                      ProtocolEvent::kForwardAntSent,
                                      ProtocolEvent::kForwardAntRelayed,
                                      ProtocolEvent::kForwardAntAnswered,
                                      ProtocolEvent::kBackwardAntRelayed,
                                      ProtocolEvent::kBackwardAntHome,
                                      ProtocolEvent::kFloodRelayed,
                                      ProtocolEvent::kFloodCopyDropped,
                                      ProtocolEvent::kProactiveAntSent,
                                      ProtocolEvent::kRepairAntSent,
                                      ProtocolEvent::kForwardAntPassedOn,
                                      ProtocolEvent::kForwardAntDropped,
                                      ProtocolEvent::kPheromoneBootstrapped,
                                      ProtocolEvent::kLossNoticeSent,
                                      ProtocolEvent::kLossNoticeReceived,
                                      ProtocolEvent::kWarningSent,
                                      ProtocolEvent::kWarningReceived,
                                      ProtocolEvent::kRepairSucceeded,
                                      ProtocolEvent::kRepairFailed,
                                      ProtocolEvent::kMessageSalvaged};

constinit const ProtocolKind kAntHocNetKind{
    .name = "anthocnet",
    .make = make_as<AntHocNet>,
    .name_frame =
        [](const SentFrame& frame) {
          return frame_name(frame.bytes, [](const Control& control) -> std::string_view {
            if (control.protocol != ControlOf::kAntHocNet) return {};
            const auto packet = anthocnet::parse_control(control.body);
            return packet ? anthocnet::name_of(*packet) : std::string_view();
          });
        },
    .weigh = no_weight,  // chosen by pheromone, which a Route does not contain
    .events = kAntHocNetEvents};

}  // namespace hal::node::routing
