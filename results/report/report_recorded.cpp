#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

constexpr std::size_t kMostRows = 40;  ///< Rows of a table before it is cut off.

/// Sums of values over all runs of a group.
class ValueSums {
 public:
  void add(const RunResult::Values& one) {
    unit_ = one.unit;
    count_ += one.count;
    if (!one.mean) return;
    sum_ += *one.mean * static_cast<double>(one.count);
    least_ = std::min(*one.least, least_.value_or(*one.least));
    most_ = std::max(*one.most, most_.value_or(*one.most));
    last_ = one.last;
  }

  std::vector<std::string> cells(const std::string& name, const std::string& agent,
                                 bool has_last) const {
    const auto text = [](const std::optional<double>& value) {
      return value ? fmt::format("{:.6g}", *value) : std::string("-");
    };
    const auto mean = least_ ? std::optional(sum_ / static_cast<double>(count_)) : std::nullopt;
    std::vector<std::string> row = {
        name,         agent,      unit_.empty() ? "-" : unit_, std::to_string(count_), text(mean),
        text(least_), text(most_)};
    if (has_last) row.push_back(text(last_));
    return row;
  }

 private:
  std::string unit_;
  std::uint64_t count_ = 0;
  double sum_ = 0;
  std::optional<double> least_, most_, last_;
};

RecordedTable values_table(const Group& group, std::string title, const char* file,
                           std::vector<RunResult::Values> RunResult::*member) {
  RecordedTable table{std::move(title), file, {}};
  std::map<std::pair<std::string, std::string>, ValueSums> sums;
  std::vector<std::pair<std::string, std::string>> order;  // names and agents as they appear
  for (const RunResult* run : group.runs) {
    for (const RunResult::Values& one : run->*member) {
      const std::pair key(one.name, one.agent);
      if (!sums.contains(key)) order.push_back(key);
      sums[key].add(one);
    }
  }
  if (sums.empty()) return table;
  std::ranges::stable_sort(order, {}, &std::pair<std::string, std::string>::first);
  const bool has_last = group.runs.size() == 1;
  table.rows = {{"quantity", "agent", "unit", "values", "mean", "least", "most"}};
  if (has_last) table.rows.front().emplace_back("last");
  for (const auto& key : order) {
    table.rows.push_back(sums.at(key).cells(key.first, key.second, has_last));
  }
  return table;
}

RecordedTable states_table(const Group& group) {
  struct Sums {
    std::size_t runs = 0;
    std::uint64_t entries = 0;
    double first = 0;  ///< Earliest time, s.
  };
  std::map<std::pair<std::string, std::string>, Sums> sums;
  std::vector<std::pair<std::string, std::string>> order;
  for (const RunResult* run : group.runs) {
    for (const RunResult::State& one : run->states) {
      const std::pair key(one.agent, one.state);
      const bool is_new = !sums.contains(key);
      if (is_new) order.push_back(key);
      Sums& sum = sums[key];
      sum.first = is_new ? one.first : std::min(sum.first, one.first);
      sum.entries += one.entries;
      ++sum.runs;
    }
  }
  RecordedTable table{"states that controllers named", "states", {}};
  if (order.empty()) return table;
  table.rows = {{"agent", "state", "runs", "entered", "first s"}};
  for (const auto& key : order) {
    const Sums& sum = sums.at(key);
    table.rows.push_back({key.first, key.second, std::to_string(sum.runs),
                          std::to_string(sum.entries), number(sum.first, 3)});
  }
  return table;
}

std::string text_of(const RecordedTable& table) {
  TextTable text;
  for (std::size_t i = 0; i < std::min(table.rows.size(), kMostRows + 1); ++i) {
    text.add_row(table.rows[i]);
  }
  if (table.rows.size() <= kMostRows + 1) return text.text();
  return text.text() + fmt::format("{} more rows: baraka export DIR {}\n",
                                   table.rows.size() - kMostRows - 1, table.file);
}

}  // namespace

std::vector<RecordedTable> recorded_tables(const Group& group) {
  std::vector<RecordedTable> tables = {
      values_table(group, "values that controllers recorded", "recorded", &RunResult::recorded),
      states_table(group),
      values_table(group, "observables", "observable_sums", &RunResult::observables)};
  std::erase_if(tables, [](const RecordedTable& table) { return table.rows.empty(); });
  return tables;
}

std::string recorded_section(const Group& group) {
  std::string text;
  for (const RecordedTable& table : recorded_tables(group)) {
    text += fmt::format("{}{}: {}, {} run{}\n{}", text.empty() ? "" : "\n", group.name, table.title,
                        group.runs.size(), group.runs.size() == 1 ? "" : "s", text_of(table));
  }
  return text;
}

}  // namespace results::report
