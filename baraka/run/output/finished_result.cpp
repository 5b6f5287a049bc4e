#include "baraka/run/output/finished_result.h"

#include <fmt/format.h>

#include <exception>
#include <fstream>
#include <iterator>

#include "gateway/process/exit_status.h"
#include "results/campaign/extension.h"
#include "results/record/replay_log.h"
#include "results/record/run_reader.h"
#include "sim/scenario/plot_request.h"

namespace baraka::run::output {

std::optional<FinishedResult> finished_result(const std::filesystem::path& folder,
                                              std::optional<std::uint64_t> seed) {
  if (!std::filesystem::exists(folder / results::record::kResultsFile)) return std::nullopt;
  try {
    results::record::RunReader reader(folder);
    if (seed && reader.value("seed") != std::to_string(*seed)) return std::nullopt;
    const std::optional<std::int64_t> status = reader.integer("exit_status");
    if (status != gateway::process::kDone && status != gateway::process::kExpectationNotMet)
      return std::nullopt;
    return FinishedResult{static_cast<int>(*status), reader.value("result"),
                          reader.value("fingerprint"), reader.value("frames_digest")};
  } catch (const std::exception&) {
    return std::nullopt;  // cut short before its tables were complete
  }
}

void require_result_of(const std::filesystem::path& folder, const std::string& resolved,
                       const std::string& until) {
  std::ifstream in(folder / "scenario.resolved.yaml");
  const std::string there{std::istreambuf_iterator<char>(in), {}};
  const std::string before = sim::scenario::without_report_only(there);
  const std::string now = sim::scenario::without_report_only(resolved);
  const std::string until_there = results::record::read_settings(folder)["--until"];
  if (before == now && until_there == until) return;
  throw gateway::process::UsageError(fmt::format(
      "{}: holds the result of another run: {}; give another --out, or remove the folder",
      folder.string(),
      before != now ? results::campaign::first_difference(before, now)
                    : fmt::format("--until: there '{}', now '{}'", until_there, until)));
}

}  // namespace baraka::run::output
