#include <fmt/format.h>

#include "results/campaign/campaign_file.h"
#include "results/campaign/campaign_reader.h"
#include "results/campaign/schema.h"
#include "results/report/experiment.h"

namespace results::report {
namespace {

using campaign::CampaignReader;

/// Points are numbered from 1 and may have gaps.
std::map<int, std::size_t> read_points(CampaignReader& reader, Experiment& experiment) {
  for (const campaign::Factor& factor : reader.factors()) {
    experiment.factors.push_back({factor.key, factor.unit});
  }
  std::map<int, std::size_t> places;
  for (const campaign::PointRow& row : reader.points()) {
    places[row.point] = experiment.points.size();
    if (experiment.points.empty()) {
      experiment.scenario = row.scenario;
      experiment.observables = sim::scenario::observables_of(row.scenario);
      experiment.scenario_place =
          fmt::format("{}: table points, row {}",
                      (reader.folder() / campaign::kCampaignDatabase).string(), row.point);
    }
    Experiment::Point& point = experiment.points.emplace_back();
    for (const campaign::Level& level : row.levels) {
      point.levels.push_back({level.text.empty() ? "-" : level.text, level.number});
    }
  }
  return places;
}

std::map<std::int64_t, std::size_t> read_runs(CampaignReader& reader, Experiment& experiment,
                                              const std::map<int, std::size_t>& points) {
  std::map<std::int64_t, std::size_t> places;
  for (const campaign::RunRow& row : reader.runs()) {
    const std::string name = fmt::format("run {}", row.plan.run);
    if (row.state != campaign::RunState::kDone) {
      experiment.left_out.push_back(fmt::format("{}: {}{}{}", name, name_of(row.state),
                                                row.error.empty() ? "" : ": ", row.error));
      continue;
    }
    const std::size_t point = points.at(row.plan.point);
    places[row.plan.run] = experiment.runs.size();
    experiment.points[point].runs.push_back(experiment.runs.size());
    experiment.runs.push_back({name, point, row.plan.seed});
  }
  return places;
}

using Places = std::map<std::int64_t, std::size_t>;
using Quantities = std::map<std::int64_t, Experiment::Quantity>;

Quantities read_quantities(CampaignReader& reader, Experiment& experiment) {
  Quantities quantities;
  record::Statement rows = reader.query("SELECT observable, name, unit, agent FROM observables");
  while (rows.next()) {
    quantities[rows.integer(0)] = {rows.text(1), rows.text(3)};
    experiment.units[rows.text(1)] = rows.text(2);
  }
  return quantities;
}

/// The quantity of a row's observable. @throws std::runtime_error  the table `observables` lacks it
const Experiment::Quantity& quantity_of(const record::Statement& row,
                                        const Quantities& quantities) {
  const auto found = quantities.find(row.integer(1));
  if (found == quantities.end()) row.refuse(1, "not in the table observables");
  return found->second;
}

void read_values(CampaignReader& reader, Experiment& experiment, const Places& runs,
                 const Quantities& quantities) {
  record::Statement values =
      reader.query("SELECT run, observable, value FROM measurements WHERE value IS NOT NULL");
  while (values.next()) {
    const auto run = runs.find(values.integer(0));
    if (run == runs.end()) continue;
    experiment.values[quantity_of(values, quantities)][run->second] = values.real(2);
  }
  record::Statement samples = reader.query(
      "SELECT run, observable, at_s, value, rowid FROM series WHERE value IS NOT NULL ORDER BY run,"
      " observable, at_s");
  while (samples.next()) {
    const auto run = runs.find(samples.integer(0));
    if (run == runs.end()) continue;
    experiment.series[quantity_of(samples, quantities)][run->second].emplace_back(samples.real(2),
                                                                                  samples.real(3));
  }
  record::Statement bins =
      reader.query("SELECT run, observable, lower, upper, count, rowid FROM bins");
  while (bins.next()) {
    const auto run = runs.find(bins.integer(0));
    if (run == runs.end()) continue;
    experiment.bins[quantity_of(bins, quantities)][run->second].push_back(
        {bins.real(2), bins.real(3), static_cast<std::uint64_t>(bins.integer(4))});
  }
}

}  // namespace

Experiment experiment_of_campaign(const std::filesystem::path& folder) {
  CampaignReader reader(folder);
  Experiment experiment;
  std::map<std::string, std::string> asked;
  record::Statement keys = reader.query("SELECT key, value FROM campaign");
  while (keys.next()) asked[keys.text(0)] = keys.text(1);
  experiment.requests = sim::scenario::requests_in(asked);
  if (const std::string& pace = asked["pace"]; pace != campaign::kLockstep)
    experiment.real_time = pace;
  const auto points = read_points(reader, experiment);
  const Places runs = read_runs(reader, experiment, points);
  read_values(reader, experiment, runs, read_quantities(reader, experiment));
  experiment.complete_open_counts();
  return experiment;
}

}  // namespace results::report
