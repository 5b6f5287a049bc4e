#include <fmt/format.h>

#include <algorithm>

#include "results/report/comparison_figures.h"
#include "results/report/paper.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

std::optional<double> times_paper(const ComparisonFigure& figure, const Group& group) {
  if (!group.is_the_papers() || figure.theirs == 0 || !figure.value) return std::nullopt;
  const auto ours = figure.value(group);
  return ours ? std::optional(*ours / figure.theirs) : std::nullopt;
}

/// Lists the groups that must not be compared with the paper's figures, and why.
std::string why_no_paper(const std::vector<Group>& groups) {
  std::string text;
  for (const Group& group : groups) {
    if (group.not_the_papers.empty()) continue;
    text += fmt::format("{}: not the paper's case study: {}\n", group.name, group.not_the_papers);
  }
  return text;
}

/// Lists the full names of groups with shortened names.
std::string legend(const std::vector<Group>& groups) {
  std::string text;
  for (const Group& group : groups) {
    if (!group.full_name.empty()) text += fmt::format("{}: {}\n", group.name, group.full_name);
  }
  return text;
}

std::string far_off_text(const std::vector<ComparisonRow>& rows, const std::vector<Group>& groups) {
  std::string text;
  for (const ComparisonRow& row : rows) {
    if (row.figure.ends_with(" ns")) continue;  // the line in ms has the same value
    for (std::size_t i = 0; i < groups.size(); ++i) {
      if (!is_far_off(row.times_paper[i])) continue;
      text += fmt::format("  {}, {}: {}, {:.2g} times the paper's\n", groups[i].name, row.figure,
                          row.ours[i], *row.times_paper[i]);
    }
  }
  return text.empty() ? "" : "More than a factor of two off\n" + text;
}

std::string about_the_paper(const std::vector<ComparisonRow>& rows,
                            const std::vector<Group>& groups) {
  return fmt::format("{}\n{}{}\n", paper::kBasisMeaning, far_off_text(rows, groups),
                     paper::kNoTail);
}

}  // namespace

bool is_far_off(const std::optional<double>& times_paper) {
  return times_paper && (*times_paper > 2 || *times_paper < 0.5);
}

/// Whether no group has a value ("-"). A count of 0 is a value.
static bool is_missing(const ComparisonRow& row) {
  return std::ranges::all_of(row.ours, [](const std::string& cell) { return cell == "-"; });
}

std::vector<ComparisonRow> comparison_rows(const std::vector<Group>& groups) {
  const bool has_paper = has_the_papers(groups);
  std::vector<ComparisonRow> rows;
  for (const ComparisonFigure& figure : comparison_figures(has_paper)) {
    if (figure.is_of_the_paper && !has_paper) continue;
    ComparisonRow& row = rows.emplace_back();
    row.figure = figure.name;
    if (has_paper) row.paper = figure.paper;
    if (has_paper) row.basis = figure.basis;
    for (const Group& group : groups) {
      row.ours.push_back(figure.ours(group));
      row.times_paper.push_back(times_paper(figure, group));
    }
    if (!has_paper && is_missing(row)) rows.pop_back();
  }
  return rows;
}

std::string comparison_section(const std::vector<Group>& groups) {
  const bool has_paper = has_the_papers(groups);
  std::vector<std::string> head = {"figure"};
  if (has_paper) head.insert(head.end(), {"paper", "basis"});
  for (const Group& group : groups) head.push_back(group.name);
  TextTable table(head);
  const std::vector<ComparisonRow> rows = comparison_rows(groups);
  for (const ComparisonRow& row : rows) {
    std::vector<std::string> cells = {row.figure};
    if (has_paper) cells.insert(cells.end(), {row.paper, paper::name_of(row.basis)});
    cells.insert(cells.end(), row.ours.begin(), row.ours.end());
    table.add_row(cells);
  }
  return fmt::format(
      "Figures, pooled over the runs of the same settings but for the seed (quartiles of type 7; "
      "delay: of\nmessages to one agent, waiting for a route included{})\n{}{}{}{}",
      has_paper ? "; replica score: mean |ln(ours / paper's)| of the\nsix quartiles" : "",
      table.text(), legend(groups), why_no_paper(groups),
      has_paper ? about_the_paper(rows, groups) : "");
}

std::string differences_section(const std::vector<Group>& groups) {
  std::vector<std::string> head = {"setting"};
  for (const Group& group : groups) head.push_back(group.name);
  TextTable table(head);
  for (const Difference& difference : differences(groups)) {
    std::vector<std::string> cells = {difference.key};
    cells.insert(cells.end(), difference.values.begin(), difference.values.end());
    table.add_row(cells);
  }
  return "Settings in which these differ\n" + table.text();
}

}  // namespace results::report
