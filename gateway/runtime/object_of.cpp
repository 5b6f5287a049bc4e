#include "gateway/runtime/object_of.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gateway::runtime {
namespace {

/// Indices in a reading of the channel battery (hal/types/channel.h).
constexpr std::size_t kCharge = 0, kEnergy = 3, kCapacity = 4;

/// Cuts between characters, so that UTF-8 text remains valid.
std::string_view cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  const auto is_inside_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
  };
  while (limit > 0 && is_inside_character(limit)) --limit;
  return text.substr(0, limit);
}

}  // namespace

template <class Interface>
hal::AgentId ObjectOf<Interface>::id() const {
  context_.guard.check("id");
  return context_.session.agent;
}

template <class Interface>
std::string_view ObjectOf<Interface>::name() const {
  context_.guard.check("name");
  return context_.session.name;
}

template <class Interface>
hal::Time ObjectOf<Interface>::now() const {
  context_.guard.check("now");
  return context_.now;
}

template <class Interface>
hal::Duration ObjectOf<Interface>::control_period() const {
  context_.guard.check("control_period");
  return context_.session.control_period;
}

template <class Interface>
std::string_view ObjectOf<Interface>::air_interface() const {
  context_.guard.check("air_interface");
  return context_.session.air_interface;
}

template <class Interface>
std::optional<hal::AgentId> ObjectOf<Interface>::address_of(std::string_view name) const {
  context_.guard.check("address_of");
  return context_.has_names("address_of") ? context_.directory.address_of(name) : std::nullopt;
}

template <class Interface>
std::optional<std::string_view> ObjectOf<Interface>::name_of(hal::AgentId agent) const {
  context_.guard.check("name_of");
  return context_.has_names("name_of") ? context_.directory.name_of(agent) : std::nullopt;
}

template <class Interface>
hal::Result<hal::MessageId> ObjectOf<Interface>::send(hal::AgentId destination,
                                                      std::string_view topic,
                                                      std::span<const std::uint8_t> payload,
                                                      const hal::SendOptions& options) {
  context_.guard.check("send");
  context_.outbox.add(hal::node::exchange::Send{.id = context_.last_message + 1,
                                                .destination = destination,
                                                .topic = std::string(topic),
                                                .payload = {payload.begin(), payload.end()},
                                                .priority = options.priority});
  if (auto good = context_.judge_last(); !good) return tl::unexpected(good.error());
  if (const auto admitted = context_.topics.admit(topic); !admitted) {
    context_.outbox.take_back();
    return context_.refuse("send", admitted.error().message);
  }
  return ++context_.last_message;
}

template <class Interface>
hal::Network& ObjectOf<Interface>::network() {
  context_.guard.check("network");
  return network_;
}

template <class Interface>
const hal::Network& ObjectOf<Interface>::network() const {
  context_.guard.check("network");
  return network_;
}

template <class Interface>
hal::Result<void> ObjectOf<Interface>::set_timer(hal::TimerId id, hal::Time at) {
  context_.guard.check("set_timer");
  if (at < context_.now) {
    return context_.refuse(
        "set_timer", fmt::format("timer {}: at {} s is before now, {} s", id, hal::to_seconds(at),
                                 hal::to_seconds(context_.now)));
  }
  context_.timers[id] = at;
  context_.outbox.add(hal::node::exchange::SetTimer{id, at});
  return {};
}

template <class Interface>
std::span<const hal::Channel> ObjectOf<Interface>::channels() const {
  context_.guard.check("channels");
  return context_.readings.channels();
}

template <class Interface>
hal::Result<std::span<const double>> ObjectOf<Interface>::reading(std::string_view channel) const {
  context_.guard.check("reading");
  return context_.readings.values(channel);
}

template <class Interface>
hal::Result<hal::Vec2> ObjectOf<Interface>::relative_position(hal::AgentId other) const {
  context_.guard.check("relative_position");
  const auto triples = context_.readings.values("localisation");
  if (!triples) return tl::unexpected<hal::Error>(triples.error());
  for (std::size_t i = 0; i + 2 < triples->size(); i += 3) {
    if ((*triples)[i] == other.value) return hal::Vec2{(*triples)[i + 1], (*triples)[i + 2]};
  }
  return hal::fail(hal::Errc::kNotAvailable, fmt::format("agent {} is not localised", other.value));
}

template <class Interface>
hal::Result<double> ObjectOf<Interface>::of_battery(std::size_t value) const {
  const auto gauge = context_.readings.values("battery");
  if (!gauge) return tl::unexpected<hal::Error>(gauge.error());
  if (value >= gauge->size() || std::isnan((*gauge)[value]))
    return hal::fail(hal::Errc::kNotAvailable, "the battery gauge gives no such value");
  return (*gauge)[value];
}

template <class Interface>
hal::Result<double> ObjectOf<Interface>::battery() const {
  context_.guard.check("battery");
  return of_battery(kCharge);
}

template <class Interface>
hal::Result<double> ObjectOf<Interface>::battery_energy() const {
  context_.guard.check("battery_energy");
  return of_battery(kEnergy);
}

template <class Interface>
hal::Result<double> ObjectOf<Interface>::battery_capacity() const {
  context_.guard.check("battery_capacity");
  return of_battery(kCapacity);
}

template <class Interface>
void ObjectOf<Interface>::set_radio(bool on) {
  context_.guard.check("set_radio");
  context_.outbox.add(hal::node::exchange::SetRadio{on});
}

template <class Interface>
hal::RandomStream& ObjectOf<Interface>::random() {
  context_.guard.check("random");
  return context_.random;
}

template <class Interface>
void ObjectOf<Interface>::state(std::string_view name) {
  context_.guard.check("state");
  if (name.empty()) {
    // The function cannot return an error, so it is only logged.
    (void)context_.refuse(
        "state", fmt::format("name is empty, 1 to {} bytes are allowed", hal::kMaxRecordedName));
    return;
  }
  const auto& declared = context_.states;
  if (!declared.empty() && std::ranges::find(declared, name) == declared.end()) {
    (void)context_.refuse(
        "state", fmt::format("'{}' is not one of the states that the controller declares: {}", name,
                             fmt::join(declared, ", ")));
    return;
  }
  context_.outbox.add(hal::node::exchange::SetState{std::string(cut(name, hal::kMaxRecordedName))});
}

template <class Interface>
void ObjectOf<Interface>::record(std::string_view name, double value) {
  context_.guard.check("record");
  const auto& declared = context_.records;
  if (!declared.empty() && std::ranges::find(declared, name) == declared.end()) {
    (void)context_.refuse(
        "record", fmt::format("'{}' is not one of the values that the controller declares: {}",
                              name, fmt::join(declared, ", ")));
    return;
  }
  context_.outbox.add(hal::node::exchange::Record{std::string(name), value, context_.now});
  if (!context_.judge_last()) return;  // logged: the function cannot return an error
  if (const auto admitted = context_.recorded.admit(name); !admitted) {
    context_.outbox.take_back();
    (void)context_.refuse("record", admitted.error().message);
  }
}

template <class Interface>
void ObjectOf<Interface>::log(hal::log::Level level, std::string_view text) {
  context_.guard.check("log");
  context_.log_of_controller(level, text);
}

template class ObjectOf<hal::Mote>;
template class ObjectOf<hal::Robot>;

}  // namespace gateway::runtime
