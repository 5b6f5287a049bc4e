#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
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

/// A value of a key that is varied.
struct FactorValue {
  std::string key;    ///< Dotted path.
  std::string text;   ///< For people.
  std::string yaml;   ///< Behind `--set key=`.
  std::string place;  ///< "file:line:column".
};

/// Settings that are to be run: in a grid or hypercube every key, in a list those it names.
using DesignPoint = std::vector<FactorValue>;

/// What a factor of a Latin hypercube may be.
struct SampledRange {
  std::string key;
  std::string place;
  double from = 0, to = 0;  ///< In `unit`.
  std::string unit;         ///< "1": none.
  bool logarithmic = false;
  bool whole = false;
  std::vector<hal::files::config::WrittenValue> choices{};  ///< Not empty: one of these instead.
};

/// A campaign file: which runs of a scenario there are to do.
struct CampaignFile {
  std::string name;
  std::string scenario;        ///< As written.
  std::string scenario_place;  ///< "file:line:column".
  int replications = 1;
  Seeds seeds = Seeds::kCommon;
  std::optional<std::uint64_t> seed{};  ///< None: the scenario's.
  std::optional<hal::Duration> until{};
  Keep keep = Keep::kNone;
  RunControllers controllers = RunControllers::kInProcess;
  std::optional<int> jobs{};  ///< None: as many as there are processors.
  SlurmSettings slurm{};

  Design design = Design::kOnePoint;
  std::vector<std::string> keys{};     ///< That are varied, in the order of the file.
  std::vector<DesignPoint> points{};   ///< Of a grid, a list or one point.
  int samples = 0;                     ///< Of a Latin hypercube, ...
  std::vector<SampledRange> ranges{};  ///< ... and of what.
};

/// How many points and runs a campaign may have.
inline constexpr std::int64_t kMostReplications = 1'000'000, kMostRuns = 1'000'000;

/// Its keys. Nothing writes such a file.
void keys_of(hal::files::description::Fields& io, CampaignFile& c);

/// Reads a campaign from the top level of its file; notes mistakes there.
CampaignFile read_campaign(hal::files::config::Mapping in, const std::filesystem::path& file);

/// @param overrides  of the campaign file, as for load_scenario().
/// @throws hal::files::config::ConfigErrors with every mistake.
CampaignFile load_campaign(const std::filesystem::path& file,
                           const std::vector<std::string>& overrides = {});

}  // namespace results::campaign
