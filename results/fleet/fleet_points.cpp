#include "results/fleet/fleet_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"

namespace results::fleet {
namespace {

using campaign::DesignPoint;
using campaign::FactorValue;
using hal::files::config::ConfigErrors;
using hal::files::config::Mapping;

/// What the answer needs is recorded, and nothing else that grows with the time.
constexpr std::array kRecord = {
    std::pair{"record.samples", "all"},     std::pair{"record.frames", "counts"},
    std::pair{"record.messages", "counts"}, std::pair{"record.routes", "none"},
    std::pair{"record.readings", "none"},   std::pair{"record.inputs", "none"},
    std::pair{"record.pose_period", "1 s"}};

/// How busy the radios are, and whether they have frames to send.
constexpr const char* kRadios =
    "{add: [{name: radio.*.queue, every: 50 ms}, {name: radio.*.transmit_share, every: 1 s}, "
    "{name: radio.*.receive_share, every: 1 s}]}";

/// Ways of placing a group that have a `count`.
constexpr std::array kLayouts = {"circle", "line", "uniform"};

FactorValue value(const std::string& key, const std::string& text, const std::string& place) {
  return {key, text, text, place};
}

/// Later values of a key replace earlier ones.
void set(DesignPoint& point, const FactorValue& value) {
  const auto found = std::ranges::find(point, value.key, &FactorValue::key);
  if (found == point.end()) {
    point.push_back(value);
  } else {
    *found = value;
  }
}

/// As a text in single quotes of YAML (1.2.2, 7.3.2).
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text) all.append(c == '\'' ? 2 : 1, c);
  return all + "'";
}

/// DDS of the players and programs in all agents with a network.
void set_profile(DesignPoint& point, const Variant& profile, const FleetScenario& scenario) {
  for (const std::string& group : scenario.on_air) {
    const std::string key = fmt::format("agents.{}.dds.", group);
    if (!profile.vendor.empty()) set(point, value(key + "vendor", profile.vendor, profile.place));
    if (profile.xml) {
      set(point, value(key + "profile", quoted(profile.xml->string()), profile.place));
    }
  }
  for (const FactorValue& one : profile.values) set(point, one);
}

DesignPoint point_of(const FleetFile& fleet, const FleetScenario& scenario, const Case& one) {
  DesignPoint point;
  for (const FactorValue& each : fleet.set) set(point, each);
  for (const FactorValue& each : fleet.radios[one.radio].values) set(point, each);
  for (const FactorValue& each : fleet.sites[one.site].values) set(point, each);
  set_profile(point, fleet.profiles[one.profile], scenario);
  for (const auto& [key, text] : kRecord) set(point, value(key, text, fleet.scenario_place));
  set(point, value("record.observables", kRadios, fleet.scenario_place));
  // The last one, so that nothing else decides the number.
  const std::string count = fmt::format("agents.{}.{}.count", fleet.group, scenario.layout);
  std::erase_if(point, [&](const FactorValue& other) { return other.key == count; });
  point.push_back(value(count, std::to_string(one.robots), fleet.scenario_place));
  return point;
}

/// By radio, site, profile and number of robots, the last changing fastest.
std::vector<Case> cases_of(const FleetFile& fleet) {
  const std::size_t lines = fleet.radios.size() * fleet.sites.size() * fleet.profiles.size();
  std::vector<Case> cases;
  for (std::size_t line = 0; line < lines; ++line) {
    const std::size_t place = line / fleet.profiles.size();
    for (const int robots : fleet.robots) {
      cases.push_back({place / fleet.sites.size(), place % fleet.sites.size(),
                       line % fleet.profiles.size(), robots});
    }
  }
  return cases;
}

void add_case(const FleetFile& fleet, const FleetScenario& scenario, const Case& one,
              FleetPlan& plan) {
  campaign::CampaignFile& campaign = plan.campaign;
  const std::string words = words_of(fleet, one);
  campaign.labels.push_back(
      fmt::format("{}{}{} robots", words, words.empty() ? "" : ", ", one.robots));
  campaign.points.push_back(point_of(fleet, scenario, one));
  for (const FactorValue& value : campaign.points.back()) {
    if (std::ranges::find(campaign.keys, value.key) == campaign.keys.end()) {
      campaign.keys.push_back(value.key);
    }
  }
  plan.cases.push_back(one);
}

}  // namespace

std::string words_of(const FleetFile& fleet, const Case& one) {
  std::string words;
  const auto add = [&words](const std::vector<Variant>& variants, std::size_t index) {
    if (index >= variants.size() || variants[index].name.empty()) return;
    words.append(words.empty() ? "" : ", ").append(variants[index].name);
  };
  add(fleet.radios, one.radio);
  add(fleet.sites, one.site);
  add(fleet.profiles, one.profile);
  return words;
}

FleetScenario fleet_scenario(const std::filesystem::path& file, const FleetFile& fleet) {
  std::vector<std::string> overrides;
  for (const FactorValue& one : fleet.set) overrides.push_back(one.key + "=" + one.yaml);
  auto document = hal::files::config::Document::load(file, overrides);
  Mapping agents = document.root().mapping({"agents", "Groups of agents.", "{}"});
  FleetScenario scenario;
  for (const std::string& group : agents.keys()) {
    Mapping in = agents.mapping({group, "A group.", "{}"});
    if (in.has("network")) scenario.on_air.push_back(group);
    if (group != fleet.group) continue;
    for (const char* const layout : kLayouts) {
      if (in.has(layout)) scenario.layout = layout;
    }
    if (scenario.layout.empty()) {
      throw ConfigErrors({fmt::format(
          "{}: is placed one by one or on a grid; a fleet's group is placed by circle, line or "
          "uniform, whose `count` varies",
          in.place())});
    }
  }
  if (scenario.layout.empty()) {
    throw ConfigErrors(
        {fmt::format("{}: robots.group: {} has no group '{}', only {}", fleet.scenario_place,
                     file.string(), fleet.group, fmt::join(agents.keys(), ", "))});
  }
  return scenario;
}

FleetPlan plan_of(const FleetFile& fleet, const FleetScenario& scenario) {
  FleetPlan plan;
  campaign::CampaignFile& campaign = plan.campaign;
  campaign.name = fleet.name;
  campaign.scenario = fleet.scenario;
  campaign.scenario_place = fleet.scenario_place;
  campaign.replications = fleet.replications;
  campaign.seed = fleet.seed;
  campaign.until = fleet.until;
  campaign.keep = campaign::Keep::kAll;
  campaign.jobs = fleet.jobs;
  campaign.slurm = fleet.slurm;
  campaign.design = campaign::Design::kList;
  for (const Case& one : cases_of(fleet)) add_case(fleet, scenario, one, plan);
  return plan;
}

}  // namespace results::fleet
