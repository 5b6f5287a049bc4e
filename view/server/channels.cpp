#include "view/server/channels.h"

#include "sim/agents/agent_offer.h"
#include "sim/scenario/observable.h"

namespace view::server {
namespace {

/// [["x","m"],["y","m"],["yaw","rad"]]; empty if the values have no names.
Json names_json(const hal::Channel& channel) {
  JsonArray names;
  for (const auto& [name, unit] : sim::scenario::values_of(channel)) {
    if (name == "0") break;  // numbered, not named
    names.add(JsonArray().add(name).add(unit).json());
  }
  return names.json();
}

Json channel_json(const hal::Channel& channel) {
  const auto& headings = channel.headings;
  return JsonObject()
      .add("name", channel.name)
      .add("kind", channel.kind)
      .add("unit", channel.unit)
      .add("values", names_json(channel))
      .add("x", channel.position.x)
      .add("y", channel.position.y)
      .add("z", channel.position.z)
      .add("heading", channel.heading)
      .add("first", headings.empty() ? 0 : headings.front())
      .add("step", headings.size() < 2 ? 0 : headings[1] - headings[0])
      .add("low", channel.low)
      .add("high", channel.high)
      .json();
}

}  // namespace

Json channels_json(const sim::agents::AgentConfig& agent) {
  JsonArray channels;
  for (const hal::Channel& one : sim::agents::channels_of(agent)) {
    channels.add(channel_json(one));
  }
  return channels.json();
}

}  // namespace view::server
