#include "results/campaign/slurm_section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace results::campaign {
namespace {

using hal::files::description::Fields;

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
  if (!argument.starts_with("-")) return "is not an option; write '--option=value' as one argument";
  const std::string option = argument.substr(0, argument.find('='));
  const auto* const found = std::ranges::find_if(kReserved, [&](const Reserved& reserved) {
    return option == reserved.option || (!reserved.letter.empty() && !option.starts_with("--") &&
                                         option.starts_with(reserved.letter));
  });
  return found == kReserved.end() ? "" : std::string(found->why);
}

namespace {

void slurm_keys(Fields& io, SlurmSettings& c) {
  io.given_text(
      {"partition", "Partition of the cluster to submit to.", "short", "the cluster's default"},
      c.partition);
  io.optional_duration(
      {"time",
       "Time limit of a run in real time, after which Slurm ends it; none: that of the partition.",
       "2 h"},
      1, c.time);
  io.duration({"poll", "Real time between two queries of the queue (`squeue`).", "5 s"},
              {0.1, 3600}, c.poll);
  io.duration({"settle",
               "Real time after the end of a run within which its result must become visible on "
               "the shared file system.",
               "60 s"},
              {0, 3600}, c.settle);
  io.texts({"arguments", "Further arguments for `sbatch`.", "[--account=swarm, --mem=500M]"},
           c.arguments);
  for (std::size_t i = 0; i < c.arguments.size(); ++i) {
    if (const std::string why = refusal(c.arguments[i]); !why.empty())
      io.mistake("arguments", fmt::format("[{}]: '{}' {}", i, c.arguments[i], why));
  }
}

}  // namespace

void slurm_key(Fields& campaign, SlurmSettings& c) {
  campaign.inside({"slurm", "How `--engine slurm` submits the runs, as one array job."},
                  [&](Fields& io) { slurm_keys(io, c); });
}

}  // namespace results::campaign
