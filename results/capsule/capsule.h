#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace results::capsule {

/// A file that goes into a capsule, or only its digest.
struct CapsulePart {
  std::string name;  ///< In the capsule, below `controllers/` or `added/`.
  std::filesystem::path file;
  bool whole = true;  ///< False: only the digest, as of a program that was compiled.
};

/// A run that the capsule plays again.
struct Played {
  std::string label;                 ///< "seed 1", "control_phase=uniform, replication 2".
  std::string scenario;              ///< Name of its scenario in the capsule.
  std::vector<std::string> options;  ///< Of `baraka run`: --seed 1 --until 60s.
  std::string fingerprint;           ///< Of the result; not empty.
};

/// What a study is made of.
struct Study {
  std::string name;                              ///< Of the scenario or campaign.
  std::map<std::string, std::string> scenarios;  ///< Resolved; by name in the capsule.
  std::vector<Played> played;
  std::vector<CapsulePart> parts;  ///< Controllers and what was added.
  std::filesystem::path database;  ///< run.sqlite or campaign.sqlite.
  std::string report;              ///< A page; empty: none.
  std::string version;             ///< Of baraka, as the result has it.
};

/// The study in a folder of results, without controllers and report.
/// @throws std::runtime_error  no result is there, it is not complete, or it was made in real time
///   or with input from outside, so that scenario and seed do not determine it.
Study study_in(const std::filesystem::path& folder);

/// Writes a capsule: README.md, capsule.json, play.sh, the scenarios, controllers, database and
/// report.
/// @param most_rows  larger tables of the database are left empty, and named in capsule.json.
/// @throws std::runtime_error  a file cannot be read or written.
void write_capsule(const Study& content, const std::filesystem::path& file, std::int64_t most_rows);

}  // namespace results::capsule
