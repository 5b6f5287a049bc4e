#pragma once

#include <string>
#include <vector>

namespace baraka::commands {

struct CoverageCommand {
  std::string scenario;
  std::vector<std::string> overrides{};  ///< "key=value".
  std::string at{}, step{}, length{};    ///< "1.5 m", "0.5 m", "1500 B"; empty: the defaults.
  std::string area{};                    ///< "X,Y,X,Y" in m; empty: around all walls and agents.
  std::string of{};                      ///< Pattern of agents; empty: the access points.
  std::string layer = "rssi";            ///< Of an SVG file: a name of results::coverage::kLayers.
  std::string file{};                    ///< .html, .svg or .csv; empty: a summary is printed.
};

/// `baraka coverage`: where in the world of a scenario its access points are received. Returns the
/// exit status. @throws std::exception
int coverage(const CoverageCommand& options);

struct SurveyCommand {
  std::string survey;  ///< CSV
  std::string scenario;
  std::vector<std::string> overrides{};
  std::string file{};  ///< Radio file to write; empty: none.
};

/// `baraka survey`: fits the multi-wall law to measured powers. @throws std::exception
int survey(const SurveyCommand& options);

}  // namespace baraka::commands
