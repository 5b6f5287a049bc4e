#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace results::coverage {

/// A received power that was measured.
struct SurveyRow {
  double x = 0, y = 0;        ///< m, world frame
  std::optional<double> z{};  ///< m above the ground; nullopt: not in the file
  std::string access_point;
  double dbm = 0;
  std::string place{};               ///< "survey.csv:7:1"
  std::string access_point_place{};  ///< The same of its access point.
};

/// Reads a survey: CSV with a header that names the columns x, y, access_point, dbm and, if wanted,
/// z, in any order; capitals, blanks and underscores do not matter, other columns are ignored.
/// Lines that are empty or begin with # are skipped.
/// @throws hal::files::config::ConfigErrors  every mistake: "survey.csv:7:12: dbm: 'x' is not …"
/// @throws std::runtime_error  the file cannot be read.
std::vector<SurveyRow> read_survey(const std::filesystem::path& file);

}  // namespace results::coverage
