#include "results/fleet/fleet_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include "results/fleet/fleet_cause.h"
#include "results/report/text_table.h"

namespace results::fleet {
namespace {

/// Writes estimates into cells.
struct CellWriter {
  Intervals intervals;

  std::string operator()(const std::optional<Estimate>& value, std::string (*text)(double)) const {
    if (!value) return "-";
    if (!value->interval || intervals == Intervals::kNone) return text(value->value);
    return fmt::format("{} ({} … {})", text(value->value), text(value->interval->low),
                       text(value->interval->high));
  }
};

/// What is set by the parts of a line, each if there are several of it.
std::string named(const FleetFile& fleet, const FleetLine& line) {
  return words_of(fleet, {line.radio, line.site, line.profile});
}

std::string profile_name(const FleetFile& fleet, const FleetLine& line) {
  const std::string& name = fleet.profiles[line.profile].name;
  return name.empty() ? "the scenario's profile" : fmt::format("profile {}", name);
}

/// What the runner-up loses.
std::string loss_of(const FleetFile& fleet, const FleetLine& best, const FleetLine& second) {
  if (!best.largest()) return fmt::format("{} does not hold, either", profile_name(fleet, second));
  const int ahead = *best.largest() - second.largest().value_or(0);
  if (ahead > 0) {
    return fmt::format("{} loses {} {}", profile_name(fleet, second), ahead,
                       ahead == 1 ? "robot" : "robots");
  }
  const int robots = *best.largest();
  const auto air = [robots](const FleetLine& line) {
    const auto found = std::ranges::find_if(
        line.cases, [&](const CaseAnswer& one) { return one.which.robots == robots; });
    return found == line.cases.end() ? 0.0 : air_of(*found);
  };
  return fmt::format("{} holds as many and takes {} of the air with {}, not {}",
                     profile_name(fleet, second), share_text(air(second)), robots,
                     share_text(air(best)));
}

/// "so far: 4 of 12 runs, 1 failed"; "" if all ended well.
std::string progress_of(const FleetFile& fleet, const FleetLine& line) {
  const std::size_t all = line.cases.size() * static_cast<std::size_t>(fleet.replications);
  if (line.runs() >= all) return "";
  return fmt::format("so far: {} of {} runs{}", line.runs(), all,
                     line.failed() == 0 ? "" : fmt::format(", {} failed", line.failed()));
}

std::string sentence(const FleetFile& fleet, const std::vector<const FleetLine*>& ranking) {
  const FleetLine& best = *ranking.front();
  const std::string where = words_of(fleet, {best.radio, best.site, fleet.profiles.size()});
  const std::string progress = progress_of(fleet, best);
  std::string text = fmt::format("{}{} robots with {}{}.", where.empty() ? "" : where + ": ",
                                 largest_text(best), profile_name(fleet, best),
                                 progress.empty() ? "" : fmt::format(" ({})", progress));
  if (const CaseAnswer* const miss = best.first_miss(); miss != nullptr && !miss->misses.empty()) {
    const Miss& first = miss->misses.front();
    text +=
        fmt::format(" With {}, {} fails first: {}. Cause: {} ({}).", miss->which.robots,
                    fleet.needs[first.need].topic, first.what, name(first.cause), first.evidence);
  }
  if (ranking.size() > 1) {
    text += fmt::format(" Of the others, {}.", loss_of(fleet, best, *ranking[1]));
  }
  return text;
}

std::vector<std::string> air_row(const FleetLine& line, const std::string& use,
                                 const CellWriter& cell) {
  std::vector<std::string> row{use};
  for (const CaseAnswer& one : line.cases) {
    const auto found = one.air.find(use);
    if (found != one.air.end()) {
      row.push_back(cell(found->second, share_text));
    } else {
      row.emplace_back(one.runs > 0 ? "0.0 %" : "-");
    }
  }
  return row;
}

}  // namespace

std::string largest_text(const FleetLine& line) {
  const auto largest = line.largest();
  if (line.runs() == 0) return "no run";
  if (!largest) {
    return fmt::format("fewer than {}", line.cases.front().which.robots);
  }
  const bool is_all = *largest == line.cases.back().which.robots;
  return is_all ? fmt::format("at least {}", *largest) : std::to_string(*largest);
}

std::vector<std::string> sentences(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  std::vector<std::string> all;
  for (std::size_t radio = 0; radio < fleet.radios.size(); ++radio) {
    for (std::size_t site = 0; site < fleet.sites.size(); ++site) {
      const auto ranking = ranked(lines, radio, site);
      if (!ranking.empty()) all.push_back(sentence(fleet, ranking));
    }
  }
  return all;
}

Cells summary_cells(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  Cells cells{{"case", "robots", "breaks at", "topic", "limit", "cause", "evidence", "runs"}, {}};
  for (const FleetLine& line : lines) {
    const std::string words = named(fleet, line);
    std::vector<std::string> row{words.empty() ? "-" : words, largest_text(line)};
    const CaseAnswer* const miss = line.first_miss();
    if (miss == nullptr) {
      row.insert(row.end(), {"-", "-", "-", "-", "-"});
    } else if (miss->misses.empty()) {
      row.insert(row.end(), {std::to_string(miss->which.robots), "-", "no run ended", "-", "-"});
    } else {
      const Miss& first = miss->misses.front();
      row.insert(row.end(), {std::to_string(miss->which.robots), fleet.needs[first.need].topic,
                             first.what, std::string(name(first.cause)), first.evidence});
    }
    const std::string progress = progress_of(fleet, line);
    row.push_back(progress.empty() ? std::to_string(line.runs()) : progress);
    cells.rows.push_back(std::move(row));
  }
  return cells;
}

Cells topic_cells(const FleetLine& line, Intervals intervals) {
  const CellWriter cell{intervals};
  Cells cells{{"robots", "topic", "delivered", "first try", "median", "95 %", "99 %", "age, 95 %",
               "first sample by", "runs"},
              {}};
  for (const CaseAnswer& one : line.cases) {
    for (const auto& [topic, samples] : one.topics) {
      cells.rows.push_back(
          {std::to_string(one.which.robots), topic, cell(samples.delivered, share_text),
           cell(samples.first_try, share_text), cell(samples.p50, time_text),
           cell(samples.p95, time_text), cell(samples.p99, time_text), cell(samples.age, time_text),
           cell(samples.discovered, time_text), std::to_string(one.runs)});
    }
  }
  return cells;
}

Cells air_cells(const FleetLine& line, Intervals intervals) {
  const CellWriter cell{intervals};
  std::set<std::string> uses;
  Cells cells{{"on the air"}, {}};
  std::vector<std::string> busy{"busiest radio"};
  std::vector<std::string> sum{"all transmissions"};
  for (const CaseAnswer& one : line.cases) {
    cells.head.push_back(std::to_string(one.which.robots));
    for (const auto& [use, share] : one.air) uses.insert(use);
    busy.push_back(cell(one.busy, share_text));
    sum.push_back(one.runs > 0 ? share_text(air_of(one)) : "-");
  }
  for (const std::string& use : uses) cells.rows.push_back(air_row(line, use, cell));
  cells.rows.push_back(std::move(sum));
  cells.rows.push_back(std::move(busy));
  return cells;
}

std::string fleet_text(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  std::string text;
  const auto add_table = [&text](const Cells& cells) {
    report::TextTable table(cells.head);
    for (const auto& row : cells.rows) table.add_row(row);
    text += table.text() + "\n";
  };
  for (const FleetLine& line : lines) {
    const std::string words = named(fleet, line);
    if (!words.empty()) text += words + "\n\n";
    add_table(topic_cells(line, Intervals::kNone));
    add_table(air_cells(line, Intervals::kNone));
  }
  add_table(summary_cells(fleet, lines));
  for (const std::string& one : sentences(fleet, lines)) text += one + "\n";
  return text;
}

std::string xml_of(const Variant& profile) {
  if (!profile.xml) return "";
  std::ifstream in(*profile.xml);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace results::fleet
