#include "results/campaign/slurm_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace results::campaign {
namespace {

struct Reserved {
  std::string_view option, letter, why;
};

constexpr std::string_view kOurs = "is set by the engine";
constexpr std::string_view kLost = "would make the engine lose track of the job";
constexpr std::array<Reserved, 11> kReserved{
    {{"--array", "-a", kOurs},
     {"--job-name", "-J", kOurs},
     {"--output", "-o", kOurs},
     {"--error", "-e", kOurs},
     {"--open-mode", "", kOurs},
     {"--chdir", "-D", kOurs},
     {"--wait", "-W", kLost},
     {"--wrap", "", kLost},
     {"--test-only", "", kLost},
     {"--clusters", "-M", kLost},
     {"--no-requeue", "", "would lose the runs of a node that fails"}}};

}  // namespace

std::string refusal(const std::string& argument) {
  if (!argument.starts_with("-")) return "is no option; write '--option=value' as one argument";
  const std::string option = argument.substr(0, argument.find('='));
  const auto* const found = std::ranges::find_if(kReserved, [&](const Reserved& reserved) {
    return option == reserved.option || (!reserved.letter.empty() && !option.starts_with("--") &&
                                         option.starts_with(reserved.letter));
  });
  return found == kReserved.end() ? "" : std::string(found->why);
}

SlurmSettings read_slurm(hal::files::config::Mapping& campaign) {
  SlurmSettings settings;
  hal::files::config::Mapping in =
      campaign.mapping({"slurm", "How `--engine slurm` submits the runs, as one array job."});
  settings.partition =
      in.text({"partition", "Partition of the cluster.", "short", "the cluster's default"}, "");
  settings.time = in.optional_duration(
      {"time",
       "Longest wall time of a run, after which Slurm ends it; none: as the partition has it.",
       "2 h"},
      1, std::nullopt);
  settings.poll =
      in.duration({"poll", "Wall time between two looks at the queue (`squeue`).", "5 s"},
                  {0.1, 3600}, settings.poll);
  settings.settle = in.duration(
      {"settle",
       "How long after the end of a run its result may take to be seen on the shared file system.",
       "60 s"},
      {0, 3600}, settings.settle);
  std::size_t index = 0;
  for (const hal::files::config::Scalar& argument :
       in.texts({"arguments", "Further arguments of `sbatch`.", "[--account=swarm, --mem=500M]"})) {
    const std::string why = refusal(argument.text);
    if (!why.empty()) {
      in.mistake("arguments", fmt::format("[{}]: '{}' {}", index, argument.text, why));
    }
    settings.arguments.push_back(argument.text);
    ++index;
  }
  in.finish();
  return settings;
}

}  // namespace results::campaign
