#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/description/fields.h"
#include "hal/types/time.h"
#include "results/campaign/slurm_section.h"

namespace results::campaign {

enum class Seeds : std::uint8_t { kCommon, kIndependent };
enum class Keep : std::uint8_t { kNone, kFailed, kAll };
enum class RunControllers : std::uint8_t { kInProcess, kSpawn };

/// How the points of a campaign are chosen.
enum class Design : std::uint8_t { kOnePoint, kGrid, kList, kLatinHypercube };

/// "one point", "grid", "list", "latin hypercube".
std::string_view name_of(Design design);
/// "common", "independent".
std::string_view name_of(Seeds seeds);

/// The pace of a campaign that sets none.
inline constexpr std::string_view kLockstep = "lockstep";

/// A value of a key that is varied.
struct FactorValue {
  std::string key;    ///< Dotted path.
  std::string text;   ///< For display.
  std::string yaml;   ///< As written after `--set key=`.
  std::string place;  ///< "file:line:column".
};

/// One point to run. In a grid or hypercube it has a value of every key, in a list of the keys that
/// the entry names.
using DesignPoint = std::vector<FactorValue>;

/// The range of a factor of a Latin hypercube.
struct SampledRange {
  std::string key;
  std::string place;
  double from = 0, to = 0;  ///< Limits, in `unit`.
  std::string unit;         ///< "1": no unit.
  bool logarithmic = false;
  bool whole = false;
  /// If not empty, the values to choose from, instead of the limits.
  std::vector<hal::files::config::WrittenValue> choices{};
};

/// A campaign file: which runs of a scenario to carry out.
struct CampaignFile {
  std::string name;
  std::string scenario;        ///< As written.
  std::string scenario_place;  ///< "file:line:column".
  int replications = 1;
  Seeds seeds = Seeds::kCommon;
  std::optional<std::uint64_t> seed{};  ///< None: the scenario's seed.
  std::optional<hal::Duration> until{};
  Keep keep = Keep::kNone;
  RunControllers controllers = RunControllers::kInProcess;
  std::string pace{kLockstep};  ///< As for `baraka run --pace`; not checked by read_campaign().
  std::string pace_place;       ///< "file:line:column".
  std::optional<int> jobs{};    ///< Runs at the same time; none: as many as there are processors.
  SlurmSettings slurm{};

  Design design = Design::kOnePoint;
  std::vector<std::string> keys{};     ///< Varied keys, in the order of the file.
  std::vector<DesignPoint> points{};   ///< kGrid, kList and kOnePoint: the points.
  std::vector<std::string> labels{};   ///< Of the points; empty: they are made from their values.
  int samples = 0;                     ///< kLatinHypercube: number of points.
  std::vector<SampledRange> ranges{};  ///< kLatinHypercube: the factors' ranges.
};

/// Upper limits of a campaign: replications of each point, and runs in all.
inline constexpr std::int64_t kMostReplications = 1'000'000, kMostRuns = 1'000'000;

/// Describes the keys of a campaign file. Used for reading only: nothing writes such a file.
void keys_of(hal::files::description::Fields& io, CampaignFile& c);

/// Reads a campaign from the top level of its file; notes mistakes in `in`.
CampaignFile read_campaign(hal::files::config::Mapping in, const std::filesystem::path& file);

/// @param overrides  of keys of the campaign file, as for load_scenario().
/// @throws hal::files::config::ConfigErrors with every mistake.
CampaignFile load_campaign(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides = {});

}  // namespace results::campaign
