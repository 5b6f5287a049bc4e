#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/description/fields.h"
#include "hal/types/time.h"
#include "results/campaign/campaign_file.h"

namespace results::fleet {

/// What must hold of the samples of some topics. A limit that is absent asks nothing.
struct Need {
  std::string topic = "*";                     ///< Pattern of DDS topics: "*/scan".
  std::string readers = "*";                   ///< Pattern of the reading agents.
  std::string place;                           ///< "file:line:column".
  std::optional<double> delivered;             ///< Least share of the samples that arrive, 0 .. 1.
  std::optional<hal::Duration> p50, p95, p99;  ///< Longest quantiles of the latency.
  /// Longest age of the newest sample that has arrived, in 95 % of the time.
  std::optional<hal::Duration> age;
  /// Time from the start of the run by which each reader must have had its first sample.
  std::optional<hal::Duration> discovered;
};

/// One of several things to compare: a radio, a site, a profile of DDS.
struct Variant {
  std::string name;                           ///< "": there is only one, and nothing is set.
  std::vector<campaign::FactorValue> values;  ///< Keys of the scenario that it sets.
  std::optional<std::filesystem::path> xml;   ///< Profiles: the middleware's file, if any.
  std::string vendor;                         ///< Profiles: "" as in the scenario.
  std::string place{};                        ///< Profiles: "file:line:column".
};

/// A fleet file: a scenario with one robot's worth of traffic, and with how many robots to try it.
struct FleetFile {
  std::string name;
  std::string scenario;                          ///< As written.
  std::string scenario_place;                    ///< "file:line:column".
  std::string group;                             ///< The group of agents whose number varies.
  std::vector<int> robots;                       ///< Ascending numbers of its agents.
  std::vector<campaign::FactorValue> set;        ///< Keys of the scenario, at all points.
  std::vector<Variant> radios, sites, profiles;  ///< At least one each.
  std::vector<Need> needs;                       ///< At least one.
  hal::Duration warm_up = std::chrono::seconds{10};
  hal::Duration until = std::chrono::seconds{60};
  int replications = 5;
  std::optional<std::uint64_t> seed{};
  std::optional<int> jobs{};
  campaign::SlurmSettings slurm{};
};

/// Describes the keys of a fleet file. Used for reading only: nothing writes such a file.
void keys_of(hal::files::description::Fields& io, FleetFile& fleet);

/// @param overrides  of keys of the fleet file, as for load_scenario().
/// @throws hal::files::config::ConfigErrors  with every mistake.
FleetFile load_fleet(const std::filesystem::path& file,
                     const std::vector<std::string>& overrides = {});

}  // namespace results::fleet
