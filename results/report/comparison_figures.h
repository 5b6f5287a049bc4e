#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "results/report/group.h"
#include "results/report/paper.h"

namespace results::report {

/// One line of the comparison: its name, the paper's figure and ours.
struct ComparisonFigure {
  std::string name;
  std::string paper;
  std::function<std::string(const Group&)> ours;
  paper::Basis basis = paper::Basis::kNone;
  double theirs = 0;  ///< The paper's figure in the unit of `value`; 0: not to be compared.
  std::function<std::optional<double>(const Group&)> value{};
  bool is_of_the_paper = false;  ///< Shown only beside the paper's figures.
};

/// All lines, in order. @param has_paper  whether the paper's figures are shown beside them.
std::vector<ComparisonFigure> comparison_figures(bool has_paper);

}  // namespace results::report
