#include "sim/scenario/bss_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "hal/files/config/suggest.h"
#include "sim/scenario/fields.h"

namespace sim::scenario {
namespace {

constexpr const char* kBss = "bss";
constexpr const char* kNone = "none";

const Key kSsidKey{"ssid", "Name of the network (SSID), 1 to 32 bytes.", "field", "baraka"};
const Key kAccessPoints{
    "access_point",
    "Agent that is the access point, or a list of several. All other agents are stations: each "
    "associates with the access point that it receives best, and sends to others through it. "
    "Without an access point the network is ad hoc.",
    "[NAME0]"};
const Key kOwnAccessPoints{
    "access_point",
    "Access points that the agents of this group may use instead of the radio's, a name or a list; "
    "`none`: they form an ad hoc network. The agents named here are access points.",
    "[NAME0]", "those of `radio`"};

void bss_keys_of(Fields& io, radio::BssConfig& c) {
  io.duration({"beacon_interval",
               "Time between two beacons of an access point, a multiple of 1.024 ms. The beacons "
               "of several access points are spread evenly over it.",
               "102.4 ms"},
              {1.024e-3, 67.10784}, c.beacon_interval);
  io.quantity({"hysteresis",
               "A station changes to another access point when the mean RSSI of its beacons is "
               "higher by more than this.",
               "6 dB"},
              "dB", {0, 100}, c.hysteresis);
  io.number({"beacon_weight",
             "Weight of the newest beacon in the running mean of an access point's RSSI in dBm; 1: "
             "only the newest counts.",
             "0.25"},
            "1", {1e-3, 1}, c.beacon_weight);
  io.count(
      {"beacon_loss",
       "Beacon intervals without a beacon after which a station takes its access point for lost.",
       "7"},
      1, 1000, c.beacon_loss);
  io.duration({"scan_time",
               "How long a station without an access point listens before it chooses one; a random "
               "part of this is added.",
               "120 ms"},
              {1e-3, 100}, c.scan_time);
  io.duration(
      {"answer_timeout",
       "How long a station waits for the answer to an authentication or association request.",
       "200 ms"},
      {1e-3, 100}, c.answer_timeout);
  io.duration({"distribution_delay",
               "Delay of the wire between access points (the distribution system).", "1 ms"},
              {0, 10}, c.distribution_delay);
}

/// Reads one name, or a list of names.
std::vector<std::string> names_in(Mapping& in, const Key& key) {
  if (in.has_scalar(key.name)) return {in.text(key)};
  std::vector<std::string> names;
  for (const hal::files::config::Scalar& name : in.texts(key)) names.push_back(name.text);
  return names;
}

std::vector<std::string> read_names(Mapping& in, const Key& key) {
  std::vector<std::string> names = names_in(in, key);
  std::vector<std::string> sorted = names;
  std::ranges::sort(sorted);
  const auto twice = std::ranges::adjacent_find(sorted);
  if (twice != sorted.end()) {
    in.mistake(key.name, fmt::format("'{}' is named twice", *twice));
  }
  return names;
}

void check_names(Mapping in, const Key& key, const std::vector<std::string>& names,
                 const std::vector<std::string>& agents) {
  for (const std::string& name : names) {
    if (name.empty() || std::ranges::count(agents, name) > 0) continue;
    in.mistake(key.name, fmt::format("unknown agent '{}'{}", name,
                                     hal::files::config::suggestion(name, agents)));
  }
}

void check_own_names(Mapping in, const std::vector<std::string>& agents) {
  const std::vector<std::string> names = names_in(in, kOwnAccessPoints);
  if (names != std::vector<std::string>{kNone}) check_names(in, kOwnAccessPoints, names, agents);
}

}  // namespace

void keys_of(Fields& io, radio::BssConfig& c) {
  io.own(
      kAccessPoints,
      [&](Mapping& in) {
        c.access_points = read_names(in, kAccessPoints);
        if (c.access_points == std::vector<std::string>{kNone}) c.access_points.clear();
      },
      [&](Writer& out) { out.texts(kAccessPoints.name, c.access_points); });
  io.text(kSsidKey, c.ssid);
  bss_keys_of(io, c);
}

void own_access_points_key(Fields& io, std::optional<std::vector<std::string>>& names) {
  const Key key{kBss, "The access points of these agents, where they differ from `radio.bss`."};
  io.only(io.reading() != nullptr || names.has_value(), {}, "", [&](Fields& given) {
    given.inside(key, [&](Fields& bss) {
      bss.own(
          kOwnAccessPoints,
          [&](Mapping& in) {
            const std::vector<std::string> own = read_names(in, kOwnAccessPoints);
            if (in.has(kOwnAccessPoints.name))
              names = own == std::vector<std::string>{kNone} ? std::vector<std::string>{} : own;
          },
          [&](Writer& out) {
            if (names->empty()) return out.text(kOwnAccessPoints.name, kNone);
            out.texts(kOwnAccessPoints.name, *names);
          });
    });
  });
}

namespace {

/// The access points that each agent may use, and the channel of each agent.
class Reach {
 public:
  Reach(const Scenario& scenario, const radio::DcfConfig& network) : network_(network) {
    for (const agents::AgentConfig& agent : scenario.simulation.agents) {
      channels_[agent.name] = channel_of(agent);
      for (const std::string& name : access_points_of(agent)) access_points_.insert(name);
    }
  }

  bool has_access_points() const { return !access_points_.empty(); }

  /// Whether the agent would wait for an access point for ever.
  bool is_lost(const agents::AgentConfig& agent) const {
    const std::vector<std::string>& usable = access_points_of(agent);
    if (usable.empty() || access_points_.contains(agent.name)) return false;
    return std::ranges::none_of(usable, [&](const std::string& name) {
      const auto there = channels_.find(name);
      return there == channels_.end() || there->second == channel_of(agent);
    });
  }
  /// Whether stations may use this access point, and some of them have an access point on their
  /// channel, but none is on the channel of this one. If all stations lack an access point, they
  /// are reported instead.
  bool is_alone(const agents::AgentConfig& access_point, const Scenario& scenario) const {
    if (!access_points_.contains(access_point.name)) return false;
    bool has_served = false;
    for (const agents::AgentConfig& agent : scenario.simulation.agents) {
      const std::vector<std::string>& usable = access_points_of(agent);
      const bool may_use = std::ranges::find(usable, access_point.name) != usable.end();
      if (!may_use || access_points_.contains(agent.name)) continue;
      if (channel_of(agent) == channel_of(access_point)) return false;
      has_served = has_served || !is_lost(agent);
    }
    return has_served;
  }
  std::uint32_t channel_of(const agents::AgentConfig& agent) const {
    return agent.radio.channel.value_or(network_.phy.channel);
  }

 private:
  const std::vector<std::string>& access_points_of(const agents::AgentConfig& agent) const {
    return agent.radio.access_points ? *agent.radio.access_points : network_.bss.access_points;
  }
  const radio::DcfConfig& network_;
  std::map<std::string, std::uint32_t> channels_;
  std::set<std::string> access_points_;
};

using AgentsById = std::map<hal::AgentId, const agents::AgentConfig*>;

void warn_of_lone_access_points(Mapping& in, const Scenario& scenario, const Reach& reach,
                                const AgentsById& by_id) {
  for (const Group& group : scenario.groups) {
    for (const hal::AgentId id : group.agents) {
      const agents::AgentConfig& agent = *by_id.at(id);
      if (!reach.is_alone(agent, scenario)) continue;
      in.within("agents")
          .within(group.name)
          .warn("radio", fmt::format("no station that may use the access point '{}' is on its "
                                     "channel, {}: no station can associate with it",
                                     agent.name, reach.channel_of(agent)));
    }
  }
}

void warn_of_lost_stations(Mapping& in, const Scenario& scenario, const AgentsById& by_id) {
  const Reach reach(scenario, *dcf_of(scenario.simulation.radio));
  Mapping radio = in.within("radio");
  if (radio.has(kBss) && !reach.has_access_points()) {
    radio.warn(kBss, "no access point is named: the network is ad hoc");
  }
  warn_of_lone_access_points(in, scenario, reach, by_id);
  for (const Group& group : scenario.groups) {
    const auto lost = std::ranges::find_if(
        group.agents, [&](hal::AgentId id) { return reach.is_lost(*by_id.at(id)); });
    if (lost == group.agents.end()) continue;
    const agents::AgentConfig& agent = *by_id.at(*lost);
    in.within("agents")
        .within(group.name)
        .warn(
            "radio",
            fmt::format(
                "none of the access points of '{}' is on its channel, {}: it will never associate",
                agent.name, reach.channel_of(agent)));
  }
}

}  // namespace

void check_access_points(Mapping& in, const Scenario& scenario) {
  const radio::DcfConfig* const dcf = dcf_of(scenario.simulation.radio);
  if (dcf == nullptr) return;
  std::vector<std::string> names;
  AgentsById by_id;
  for (const agents::AgentConfig& agent : scenario.simulation.agents) {
    names.push_back(agent.name);
    by_id[agent.id] = &agent;
  }
  check_names(in.within("radio").within(kBss), kAccessPoints, dcf->bss.access_points, names);
  for (const Group& group : scenario.groups) {
    const bool has_own = std::ranges::any_of(group.agents, [&by_id](hal::AgentId id) {
      const auto& own = by_id.at(id)->radio.access_points;
      return own && !own->empty();
    });
    if (!has_own) continue;
    Mapping radio = in.within("agents").within(group.name).within("radio");
    check_own_names(radio.within(kBss), names);
    for (Mapping& some : radio.items("overrides")) check_own_names(some.within(kBss), names);
  }
  warn_of_lost_stations(in, scenario, by_id);
}

}  // namespace sim::scenario
