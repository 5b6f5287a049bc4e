#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "sim/report/paper.h"
#include "sim/report/report_format.h"
#include "sim/report/report_sections.h"
#include "sim/report/text_table.h"

namespace sim::report {
namespace {

/// One line of the comparison: what it is, the paper's figure, ours.
struct Figure {
  std::string name;
  std::string paper;
  std::function<std::string(const Group&)> ours;
};

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

template <class Read>
std::vector<double> of_runs(const Group& group, Read read) {
  std::vector<double> values;
  for (const RunResult* run : group.runs) values.push_back(static_cast<double>(read(*run)));
  return values;
}

template <class Read>
std::vector<double> of_drives(const Group& group, Read read) {
  std::vector<double> values;
  for (const RobotDrive& drive : group.all_drives()) {
    if (const std::optional<double> value = read(drive)) values.push_back(*value);
  }
  return values;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

std::string results_of(const Group& group) {
  std::map<std::string, int> results;
  for (const RunResult* run : group.runs) ++results[run->value("result")];
  std::string text;
  for (const auto& [result, count] : results) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, result);
  }
  return text.empty() ? "-" : text;
}

std::string range_of(const std::vector<double>& values, int decimals) {
  if (values.empty()) return "-";
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{} .. {}", number(*least, decimals), number(*most, decimals));
}

std::optional<double> delivery_ratio(const Group& group) {
  const double sent = sum(of_runs(group, [](const RunResult& run) { return run.messages; }));
  const double arrived = sum(of_runs(group, [](const RunResult& run) { return run.delivered; }));
  return sent > 0 ? std::optional(100 * arrived / sent) : std::nullopt;
}

std::optional<double> nodes_per_flood(const Group& group) {
  const double floods = sum(of_runs(group, [](const RunResult& run) { return run.floods; }));
  const double reached =
      sum(of_runs(group, [](const RunResult& run) { return run.flood_deliveries; }));
  return floods > 0 ? std::optional(reached / floods) : std::nullopt;
}

/// A figure per simulated second: of a value in the table run.
std::string per_second(const Group& group, const char* key) {
  const double counted =
      sum(of_runs(group, [key](const RunResult& run) { return run.number(key); }));
  const double time =
      sum(of_runs(group, [](const RunResult& run) { return run.number("simulated_s"); }));
  return time > 0 ? number(counted / time, 1) : "-";
}

std::string real_time_factor(const Group& group) {
  const double simulated =
      sum(of_runs(group, [](const RunResult& run) { return run.number("simulated_s"); }));
  const double wall =
      sum(of_runs(group, [](const RunResult& run) { return run.number("wall_s"); }));
  return wall > 0 ? number(simulated / wall, 1) : "-";
}

std::vector<Figure> run_figures() {
  const auto time = [](const Group& g) {
    return of_runs(g, [](const RunResult& run) { return run.number("simulated_s"); });
  };
  return {
      {"runs", std::to_string(paper::kRuns),
       [](const Group& g) { return std::to_string(g.runs.size()); }},
      {"runs left out (broken off)", "", [](const Group& g) { return std::to_string(g.left_out); }},
      {"results", "", results_of},
      {"run time, mean s", "", [time](const Group& g) { return number(mean(time(g)), 1); }},
      {"run time, range s", "", [time](const Group& g) { return range_of(time(g), 1); }},
      {"real-time factor", "> 1", real_time_factor},
      {"exchanges per s", "", [](const Group& g) { return per_second(g, "exchanges"); }},
      {"events per s", "", [](const Group& g) { return per_second(g, "events"); }},
  };
}

std::vector<Figure> drive_figures() {
  const auto path = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) { return std::optional(d.path); });
  };
  const auto ratio = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) { return std::optional(d.ratio()); });
  };
  const auto clearance = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) { return d.clearance; });
  };
  const auto contacts = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) -> std::optional<double> {
      return d.wall_steps ? std::optional(static_cast<double>(*d.wall_steps)) : std::nullopt;
    });
  };
  return {
      {"path, mean m", "", [path](const Group& g) { return number(mean(path(g)), 1); }},
      {"path / straight, mean", "", [ratio](const Group& g) { return number(mean(ratio(g)), 2); }},
      {"path / straight, range", "", [ratio](const Group& g) { return range_of(ratio(g), 2); }},
      {"clearance to walls, range m", "",
       [clearance](const Group& g) { return range_of(clearance(g), 2); }},
      {"wall contacts, sum", "",
       [contacts](const Group& g) { return number(sum(contacts(g)), 0); }},
  };
}

std::vector<Figure> message_figures() {
  const auto messages = [](const Group& g) {
    return sum(of_runs(g, [](const RunResult& run) { return run.messages; }));
  };
  const auto floods = [](const Group& g) {
    return sum(of_runs(g, [](const RunResult& run) { return run.floods; }));
  };
  const auto given_up = [](const Group& g) {
    return sum(of_runs(g, [](const RunResult& run) { return run.discoveries_failed; }));
  };
  return {
      {"messages to one agent", "", [messages](const Group& g) { return number(messages(g), 0); }},
      {"delivered %", "", [](const Group& g) { return number(delivery_ratio(g), 2); }},
      {"floods", "", [floods](const Group& g) { return number(floods(g), 0); }},
      {"agents reached per flood", "",
       [](const Group& g) { return number(nodes_per_flood(g), 2); }},
      {"routes found", "", [](const Group& g) { return std::to_string(g.discoveries().size()); }},
      {"routes given up", "", [given_up](const Group& g) { return number(given_up(g), 0); }},
  };
}

/// Five lines for minimum, quartiles and maximum.
std::vector<Figure> quantile_figures(const std::string& name, const Quantiles& theirs,
                                     std::vector<double> (Group::*sample)() const) {
  const auto line = [&](const char* which, double Quantiles::*member) -> Figure {
    return {fmt::format("{}, {} ms", name, which), milliseconds(theirs.*member),
            [sample, member](const Group& group) -> std::string {
              const auto ours = quantiles((group.*sample)());
              return ours ? milliseconds((*ours).*member) : "-";
            }};
  };
  const auto least = [sample](const Group& group) -> std::string {
    const auto ours = quantiles((group.*sample)());
    return ours ? number(ours->min * 1e9, 0) : "-";
  };
  return {{name + ", minimum ns", number(theirs.min * 1e9, 0), least},
          line("minimum", &Quantiles::min),
          line("quartile 1", &Quantiles::q1),
          line("median", &Quantiles::median),
          line("quartile 3", &Quantiles::q3),
          line("maximum", &Quantiles::max)};
}

/// Of the motes, fewest first.
std::vector<double> packets_of_motes(const Group& group) {
  std::vector<double> values;
  if (group.runs.empty()) return values;
  const auto packets = group.packets();
  for (const RunResult::Agent& agent : group.runs.front()->agents) {
    if (!agent.is_robot) values.push_back(static_cast<double>(packets.at(agent.agent)));
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::vector<Figure> packet_figures() {
  const auto most = [](const Group& g) {
    const auto values = packets_of_motes(g);
    return values.empty() ? std::string("-") : number(values.back(), 0);
  };
  const auto least = [](const Group& g) {
    const auto values = packets_of_motes(g);
    return values.empty() ? std::string("-") : number(values.front(), 0);
  };
  const auto ratio = [](const Group& g) {
    const auto values = packets_of_motes(g);
    if (values.empty() || values.front() <= 0) return std::string("-");
    return number(values.back() / values.front(), 2);
  };
  return {
      {"packets, most of a mote", number(paper::kMostPackets, 0), most},
      {"packets, least of a mote", number(paper::kLeastPackets, 0), least},
      {"packets, ratio", number(paper::kMostPackets / paper::kLeastPackets, 2), ratio},
  };
}

std::vector<Figure> all_figures() {
  std::vector<Figure> all = run_figures();
  const std::vector<Figure> score = {
      {"replica score", "0", [](const Group& g) -> std::string {
         if (!g.not_the_papers.empty()) return "-";
         return number(replica_score(quantiles(g.discoveries()), quantiles(g.delays())), 3);
       }}};
  for (const auto& part :
       {drive_figures(), message_figures(),
        quantile_figures("discovery", paper::kDiscovery, &Group::discoveries),
        quantile_figures("delay", paper::kDelay, &Group::delays), packet_figures(), score}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

/// Which columns the paper's does not belong beside.
std::string why_no_paper(const std::vector<Group>& groups) {
  std::string text;
  for (const Group& group : groups) {
    if (group.not_the_papers.empty()) continue;
    text += fmt::format("{}: not the paper's case study: {}\n", group.name, group.not_the_papers);
  }
  return text;
}

}  // namespace

std::vector<ComparisonRow> comparison_rows(const std::vector<Group>& groups) {
  std::vector<ComparisonRow> rows;
  for (const Figure& figure : all_figures()) {
    ComparisonRow& row = rows.emplace_back(ComparisonRow{figure.name, figure.paper, {}});
    for (const Group& group : groups) row.ours.push_back(figure.ours(group));
  }
  return rows;
}

std::string comparison_section(const std::vector<Group>& groups) {
  const bool has_paper = has_the_papers(groups);
  std::vector<std::string> head = {"figure"};
  if (has_paper) head.emplace_back("paper");
  for (const Group& group : groups) head.push_back(group.name);
  TextTable table(head);
  for (const ComparisonRow& row : comparison_rows(groups)) {
    std::vector<std::string> cells = {row.figure};
    if (has_paper) cells.push_back(row.paper);
    cells.insert(cells.end(), row.ours.begin(), row.ours.end());
    table.add_row(cells);
  }
  return "Figures, pooled over the runs of the same settings but for the seed (quartiles of type "
         "7; "
         "delay: of\nmessages to one agent, waiting for a route included; replica score: mean "
         "|ln(ours "
         "/ paper's)| of the\nsix quartiles)\n" +
         table.text() + why_no_paper(groups);
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

}  // namespace sim::report
