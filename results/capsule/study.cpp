#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "results/campaign/campaign_reader.h"
#include "results/campaign/schema.h"
#include "results/capsule/capsule.h"
#include "results/record/database.h"
#include "results/record/run_reader.h"

namespace results::capsule {
namespace {

namespace fs = std::filesystem;
using record::Statement;

std::string content_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

/// "--until 60s" for "60 s"; nothing for "its end".
void add_until(std::vector<std::string>& options, const std::string& until) {
  if (until.empty() || until == "its end") return;
  options.insert(options.end(), {"--until", until});
}

std::string until_of(record::RunReader& reader) {
  Statement until = reader.query("SELECT value FROM settings WHERE key = '--until'");
  return until.next() ? until.text(0) : "";
}

void require_determined(record::RunReader& reader, const fs::path& folder) {
  if (reader.is_unfinished()) {
    throw std::runtime_error(fmt::format("{}: the run has not ended", folder.string()));
  }
  const std::string pace = reader.value("pace");
  if (pace != "lockstep" || reader.count_rows().at("arrivals") > 0) {
    throw std::runtime_error(fmt::format(
        "{}: scenario and seed do not determine this run: it followed a clock or had input from "
        "outside, which only `baraka run --repeat` plays again",
        folder.string()));
  }
}

Study of_run(const fs::path& folder) {
  record::RunReader reader(folder);
  require_determined(reader, folder);
  Study content;
  content.name = reader.value("scenario");
  content.version = reader.value("version");
  content.database = folder / "run.sqlite";
  const std::string name = "scenarios/scenario.yaml";
  content.scenarios[name] = content_of_file(folder / "scenario.resolved.yaml");
  Played played{.label = "seed " + reader.value("seed"),
                .scenario = name,
                .options = {"--seed", reader.value("seed")},
                .fingerprint = reader.value("fingerprint")};
  add_until(played.options, until_of(reader));
  content.played.push_back(std::move(played));
  return content;
}

std::string value_of(record::Database& database, const std::string& key) {
  Statement value(database, fmt::format("SELECT value FROM campaign WHERE key = '{}'", key));
  return value.next() ? value.text(0) : "";
}

void add_runs(Study& content, record::Database& database, const fs::path& folder) {
  const std::string until = value_of(database, "until");
  Statement runs(database,
                 "SELECT point, label, replication, seed, state, fingerprint FROM runs JOIN points "
                 "USING (point) ORDER BY point, replication");
  while (runs.next()) {
    const std::string label = fmt::format("{}, replication {}", runs.text(1), runs.integer(2));
    if (runs.text(4) != "done" || runs.text(5).empty()) {
      throw std::runtime_error(
          fmt::format("{}: not complete: {} is {}", folder.string(), label, runs.text(4)));
    }
    Played played{.label = label,
                  .scenario = fmt::format("scenarios/point_{}.yaml", runs.integer(0)),
                  .options = {"--seed", std::to_string(runs.integer(3))},
                  .fingerprint = runs.text(5)};
    add_until(played.options, until);
    content.played.push_back(std::move(played));
  }
}

Study of_campaign(const fs::path& folder) {
  Study content;
  content.database = folder / campaign::kCampaignDatabase;
  record::Database database(content.database, record::Database::Mode::kRead);
  content.name = value_of(database, "name");
  content.version = value_of(database, "version");
  if (value_of(database, "pace") != "lockstep") {
    throw std::runtime_error(
        fmt::format("{}: its runs followed the clock, so that scenario and seed do not determine "
                    "them",
                    folder.string()));
  }
  Statement points(database, "SELECT point, scenario FROM points ORDER BY point");
  while (points.next()) {
    content.scenarios[fmt::format("scenarios/point_{}.yaml", points.integer(0))] = points.text(1);
  }
  content.scenarios["campaign.yaml"] = value_of(database, "file");
  add_runs(content, database, folder);
  return content;
}

}  // namespace

Study study_in(const fs::path& folder) {
  if (campaign::CampaignReader::has_database(folder)) return of_campaign(folder);
  return of_run(folder);
}

}  // namespace results::capsule
