#include "sim/scenario/observable.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "hal/node/devices/sensors.h"
#include "hal/types/pattern.h"
#include "sim/agents/agent_offer.h"

namespace sim::scenario {
namespace {

constexpr std::string_view kSensorsDomain = "sensors";
constexpr std::string_view kBatteryKind = "battery";

using Names = std::vector<std::pair<std::string, std::string>>;

const Names& names_of_odometry() {
  static const Names names{{"x", "m"},    {"y", "m"},    {"yaw", "rad"},
                           {"vx", "m/s"}, {"vy", "m/s"}, {"omega", "rad/s"}};
  return names;
}

/// "pose: x, y, yaw", if the values of that kind of sensor have names.
template <class Sensor>
void add_names(std::vector<std::string>& kinds) {
  if constexpr (requires { Sensor::kValues; }) {
    std::vector<std::string_view> names;
    names.reserve(Sensor::kValues.size());
    for (const auto& value : Sensor::kValues) names.push_back(value.name);
    kinds.push_back(fmt::format("{}: {}", Sensor::kKind, fmt::join(names, ", ")));
  }
}

std::string names_by_kind() {
  std::vector<std::string_view> of_odometry;
  of_odometry.reserve(names_of_odometry().size());
  for (const auto& [name, unit] : names_of_odometry()) of_odometry.push_back(name);
  std::vector<std::string> kinds{fmt::format("odometry: {}", fmt::join(of_odometry, ", "))};
  [&]<class... All>(std::type_identity<std::variant<All...>> /*all*/) {
    (add_names<All>(kinds), ...);
  }(std::type_identity<hal::node::devices::SensorDescription>{});
  return fmt::format("{}", fmt::join(kinds, "; "));
}

void add_readings(const hal::Channel& channel, std::vector<Observable>& to) {
  const Names names = values_of(channel);
  for (std::size_t i = 0; i < names.size(); ++i) {
    to.push_back({.domain = std::string(kSensorsDomain),
                  .value = channel.name + "." + names[i].first,
                  .unit = names[i].second,
                  .source = ReadingValue{channel.name, i}});
  }
  if (channel.kind == kBatteryKind) {
    to.push_back({.domain = "agents",
                  .value = "battery",
                  .unit = "1",
                  .source = ReadingValue{channel.name, 0}});
  }
}

void add_quantities(const agents::AgentConfig& agent, std::vector<Observable>& to) {
  for (const agents::Quantity& quantity : agents::quantities()) {
    for (std::size_t number = 0; quantity.has(agent, number); ++number) {
      to.push_back({.domain = std::string(quantity.domain),
                    .value = quantity.is_family ? fmt::format("{}.{}", quantity.name, number)
                                                : std::string(quantity.name),
                    .unit = std::string(quantity.unit),
                    .source = QuantityValue{&quantity, number}});
      if (!quantity.is_family) break;
    }
  }
}

}  // namespace

std::string_view name(Keeps keeps) {
  return std::ranges::find(kKeeps, keeps, &hal::files::config::Option<Keeps>::value)->name;
}

std::optional<ObservablePattern> ObservablePattern::of(std::string_view name) {
  const std::size_t first = name.find('.');
  if (first == std::string_view::npos) return std::nullopt;
  const std::size_t second = name.find('.', first + 1);
  if (second == std::string_view::npos) return std::nullopt;
  ObservablePattern parts{std::string(name.substr(0, first)),
                          std::string(name.substr(first + 1, second - first - 1)),
                          std::string(name.substr(second + 1))};
  if (parts.domain.empty() || parts.agents.empty() || parts.value.empty()) return std::nullopt;
  return parts;
}

bool ObservablePattern::has_agent(std::string_view agent) const {
  return hal::matches(agents, agent);
}

bool ObservablePattern::has_value(std::string_view value_name) const {
  return hal::matches(value, value_name);
}

Names values_of(const hal::Channel& channel) {
  if (channel.kind == "odometry") return names_of_odometry();
  const auto named = hal::node::devices::value_names(channel.kind);
  Names names;
  names.reserve(std::max<std::size_t>(named.size(), channel.length));
  for (const auto& one : named) names.emplace_back(one.name, one.unit);
  if (!named.empty()) return names;
  for (std::uint32_t i = 0; i < channel.length; ++i) {
    names.emplace_back(std::to_string(i), channel.unit);
  }
  return names;
}

std::vector<Observable> observables_of(const agents::AgentConfig& agent,
                                       const agents::SimulationConfig& config) {
  std::vector<Observable> all;
  add_quantities(agent, all);
  for (const TallyKind& kind : tally_kinds()) {
    all.push_back({.domain = std::string(kind.domain),
                   .value = std::string(kind.name),
                   .unit = std::string(kind.unit),
                   .source = kind.tally});
  }
  for (const hal::Channel& channel : agents::offer_of(agent, config).session.channels) {
    add_readings(channel, all);
  }
  return all;
}

std::vector<std::string> observable_domains() {
  std::vector<std::string> domains;
  const auto add = [&domains](std::string_view domain) {
    if (std::ranges::find(domains, domain) == domains.end()) domains.emplace_back(domain);
  };
  for (const agents::Quantity& quantity : agents::quantities()) add(quantity.domain);
  for (const TallyKind& kind : tally_kinds()) add(kind.domain);
  add(kDdsDomain);
  add(kSensorsDomain);
  add(kControllersDomain);
  return domains;
}

std::vector<ObservableKind> observable_kinds() {
  std::vector<ObservableKind> kinds;
  for (const agents::Quantity& one : agents::quantities()) {
    kinds.push_back(
        {fmt::format("{}.AGENT.{}{}", one.domain, one.name, one.is_family ? ".NUMBER" : ""),
         std::string(one.unit), std::string(one.meaning)});
  }
  kinds.push_back({"agents.AGENT.battery", "1", "state of charge that its gauge shows, 0 to 1"});
  for (const TallyKind& one : tally_kinds()) {
    kinds.push_back({fmt::format("{}.AGENT.{}", one.domain, one.name), std::string(one.unit),
                     std::string(one.meaning)});
  }
  for (const DdsValueKind& one : dds_value_kinds()) {
    kinds.push_back({fmt::format("{}.AGENT.TOPIC.{}", kDdsDomain, one.name), std::string(one.unit),
                     std::string(one.meaning)});
  }
  kinds.push_back({"sensors.AGENT.CHANNEL.VALUE", "",
                   "a value of the latest reading at a control instant of the agent, in the unit "
                   "of the channel; VALUE is its index from 0, or a name. Names by kind: " +
                       names_by_kind()});
  kinds.push_back({"controllers.AGENT.NAME", "",
                   "value that the agent's controller records under this name, in the unit that it "
                   "declares; `baraka describe CONTROLLER` lists declared values"});
  std::ranges::stable_sort(kinds, {}, [](const ObservableKind& kind) {
    const std::vector<std::string> domains = observable_domains();
    return std::ranges::find(domains, kind.name.substr(0, kind.name.find('.'))) - domains.begin();
  });
  return kinds;
}

}  // namespace sim::scenario
