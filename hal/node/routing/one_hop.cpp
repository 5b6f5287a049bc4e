#include "hal/node/routing/one_hop.h"

#include <utility>

#include "hal/node/routing/byte_order.h"
#include "hal/node/routing/frame_name.h"
#include "hal/node/routing/message_end.h"
#include "hal/types/check.h"

namespace hal::node::routing {
namespace {

constexpr std::uint8_t kToOne = 0x17;
constexpr std::uint8_t kToNeighbours = 0x18;
constexpr std::uint8_t kToEveryone = 0x19;
constexpr std::uint8_t kWithPriority = 4;  ///< Added to the kind.

std::uint8_t kind_of(AgentId destination) {
  if (destination == kNeighbours) return kToNeighbours;
  return destination == kEveryone ? kToEveryone : kToOne;
}

std::optional<AgentId> destination_of(std::uint8_t kind, AgentId self) {
  switch (kind) {
    case kToOne:
      return self;
    case kToNeighbours:
      return kNeighbours;
    case kToEveryone:
      return kEveryone;
    default:
      return std::nullopt;
  }
}

}  // namespace

Bytes encode_one_hop(const Message& message) {
  const bool has_priority = message.priority != Priority::kBestEffort;
  BARAKA_CHECK(to_number(message.priority) <= kHighestPriority);
  const std::uint8_t kind = kind_of(message.destination);
  ByteWriter out;
  out.u8(has_priority ? static_cast<std::uint8_t>(kind + kWithPriority) : kind);
  out.u8(static_cast<std::uint8_t>(message.topic.size()));
  out.bytes({message.topic.begin(), message.topic.end()});
  out.u32(message.id);
  if (has_priority) out.u8(to_number(message.priority));
  out.bytes(message.payload);
  return out.take();
}

std::optional<Message> parse_one_hop(std::span<const std::uint8_t> bytes, AgentId from,
                                     AgentId self) {
  ByteReader in(bytes);
  const std::uint8_t kind = in.u8();
  const bool has_priority = kind >= kToOne + kWithPriority;
  const auto destination =
      destination_of(has_priority ? static_cast<std::uint8_t>(kind - kWithPriority) : kind, self);
  if (!destination) return std::nullopt;
  Message message{.source = from, .destination = *destination, .id = 0, .topic = {}, .payload = {}};
  const std::size_t topic = in.u8();
  message.topic = in.text(topic);
  message.id = in.u32();
  if (has_priority) message.priority = Priority{in.u8()};
  message.payload = in.rest();
  const bool is_valid = in.ended_well() && topic > 0 && topic <= kMaxTopic && message.id != 0 &&
                        message.payload.size() <= kMaxPayload &&
                        has_priority == (message.priority != Priority::kBestEffort) &&
                        to_number(message.priority) <= kHighestPriority;
  if (!is_valid) return std::nullopt;
  return message;
}

OneHop::OneHop(AgentId self, const RouterPorts& ports)
    : self_(self),
      ports_(ports),
      timers_(ports.timers),
      neighbourhood_(ports.timers, ports.observer) {}

void OneHop::send(const Message& message) {
  const AgentId next_hop = is_broadcast(message.destination) ? kEveryone : message.destination;
  if (ports_.link.capabilities().tx_status) {
    const bool is_new = sent_.emplace(message.id, Sent{message.destination, message.topic}).second;
    BARAKA_CHECK(is_new);
  } else {
    timers_.schedule(timers_.now(), [this, id = message.id] {
      ports_.application.on_fate(id, Fate::kHandedOver);
    });
  }
  ports_.link.transmit(next_hop, encode_one_hop(message), {message.id, message.priority});
}

bool OneHop::on_frame(const Reception& reception, std::span<const std::uint8_t> bytes) {
  neighbourhood_.prefetch();
  auto message = parse_one_hop(bytes, reception.from, self_);
  if (!message) return false;
  neighbourhood_.on_heard(reception);
  ports_.observer.on_message_end(message->source, message->id, message->topic, Verdict::kDelivered);
  ports_.application.on_message(std::move(*message), 1);
  return true;
}

void OneHop::on_transmitted(const Transmission& transmission) {
  const auto sent = sent_.extract(static_cast<MessageId>(transmission.tag));
  if (sent.empty()) return;
  const auto& [destination, topic] = sent.mapped();
  const MessageId id = sent.key();
  if (transmission.verdict == Verdict::kDelivered) {
    return ports_.application.on_fate(id, Fate::kHandedOver);
  }
  if (transmission.verdict == Verdict::kRetryLimit) neighbourhood_.on_no_answer(destination);
  ports_.observer.on_message_end(self_, id, topic, transmission.verdict);
  // Here the message expired in the MAC, not during a search for a route.
  const bool was_too_old = transmission.verdict == Verdict::kExpired;
  ports_.application.on_fate(id, was_too_old ? Fate::kFailed : fate_of(transmission.verdict));
}

constinit const ProtocolKind kOneHopKind{
    .name = "none",
    .make = [](AgentId self, const RoutingConfig&, const RouterStreams&, const RouterPorts& ports)
        -> std::unique_ptr<Protocol> { return std::make_unique<OneHop>(self, ports); },
    .name_frame = [](const SentFrame& frame) -> FrameName {
      const auto message = parse_one_hop(frame.bytes, frame.from, frame.to);
      if (!message) return {};
      return {"data", FrameName::MessageName{frame.from, message->id}};
    },
    .weigh = no_weight};

}  // namespace hal::node::routing
