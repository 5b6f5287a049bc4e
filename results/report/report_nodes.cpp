#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "results/report/paper.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

using Agent = RunResult::Agent;

std::vector<Agent> motes_of(const Group& group) {
  std::vector<Agent> motes;
  for (const Agent& agent : group.runs.front()->agents) {
    if (!agent.is_robot) motes.push_back(agent);
  }
  return motes;
}

/// The motes in rows from the top (largest y), each row from the left. If they do not form a
/// complete grid, each mote has its own row.
std::vector<std::vector<Agent>> layout(std::vector<Agent> motes) {
  std::set<double> columns;
  std::set<double> rows;
  for (const Agent& mote : motes) {
    columns.insert(mote.x);
    rows.insert(mote.y);
  }
  std::vector<std::vector<Agent>> grid;
  if (columns.size() * rows.size() != motes.size() || columns.size() < 2) {
    for (const Agent& mote : motes) grid.push_back({mote});
    return grid;
  }
  std::sort(motes.begin(), motes.end(),
            [](const Agent& a, const Agent& b) { return a.y != b.y ? a.y > b.y : a.x < b.x; });
  for (const Agent& mote : motes) {
    if (grid.empty() || grid.back().size() == columns.size()) grid.emplace_back();
    grid.back().push_back(mote);
  }
  return grid;
}

/// A table with one figure per mote, arranged like the motes.
template <class Figure>
std::string grid_text(const std::vector<Agent>& motes, Figure figure) {
  TextTable table;
  for (const std::vector<Agent>& row : layout(motes)) {
    std::vector<std::string> cells = {""};
    for (const Agent& mote : row) {
      cells.push_back(mote.name);
      cells.push_back(figure(mote));
    }
    table.add_row(cells);
  }
  return table.text();
}

std::string place_of(const std::vector<Agent>& motes, const Agent& wanted) {
  const auto grid = layout(motes);
  if (grid.front().size() < 2) return wanted.name;
  for (std::size_t row = 0; row < grid.size(); ++row) {
    for (std::size_t column = 0; column < grid[row].size(); ++column) {
      if (grid[row][column].agent != wanted.agent) continue;
      return fmt::format("{} (row {} from the top, column {})", wanted.name, row + 1, column + 1);
    }
  }
  return wanted.name;
}

}  // namespace

std::string links_section(const Group& group) {
  const std::vector<Agent> motes = motes_of(group);
  std::map<int, int> degree;
  for (const Agent& mote : motes) degree[mote.agent] = 0;
  int links = 0;
  for (const auto& [a, b] : group.runs.front()->links) {
    if (!degree.contains(a) || !degree.contains(b)) continue;
    ++links;
    ++degree[a];
    ++degree[b];
  }
  return fmt::format("{}: {} links between motes; neighbours of each\n", group.name, links) +
         grid_text(motes, [&degree](const Agent& m) { return std::to_string(degree[m.agent]); });
}

std::string packets_section(const Group& group) {
  const std::vector<Agent> motes = motes_of(group);
  if (motes.empty()) return group.name + ": no motes\n";
  const auto packets = group.packets();
  const auto runs = static_cast<double>(group.runs.size());
  const auto total = [&packets](const Agent& mote) {
    return static_cast<double>(packets.at(mote.agent));
  };
  const auto [least, most] = std::minmax_element(
      motes.begin(), motes.end(),
      [&](const Agent& a, const Agent& b) { return packets.at(a.agent) < packets.at(b.agent); });
  std::string text =
      fmt::format("{}: packets received by each mote, total of {} runs\n", group.name,
                  group.runs.size()) +
      grid_text(motes, [&](const Agent& mote) { return number(total(mote), 0); }) +
      "mean per run\n" +
      grid_text(motes, [&](const Agent& mote) { return number(total(mote) / runs, 1); });
  const bool has_paper = group.is_the_papers();
  TextTable extremes(has_paper ? std::vector<std::string>{"", "total", "per run", "paper's per run"}
                               : std::vector<std::string>{"", "total", "per run"});
  for (const auto& [name, mote, paper] : {std::tuple{"most: ", *most, paper::kMostPackets},
                                          {"least: ", *least, paper::kLeastPackets}}) {
    std::vector<std::string> row = {name + place_of(motes, mote), number(total(mote), 0),
                                    number(total(mote) / runs, 1)};
    if (has_paper) row.push_back(number(paper / paper::kRuns, 1));
    extremes.add_row(row);
  }
  return text + extremes.text();
}

}  // namespace results::report
