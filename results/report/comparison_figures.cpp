#include "results/report/comparison_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "results/report/paper.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"

namespace results::report {
namespace {

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

/// Sum over the runs that count such a thing; none: no run does.
template <class Counts, class Read>
std::optional<double> counted(const Group& group, Counts counts, Read read) {
  std::optional<double> total;
  for (const RunResult* run : group.runs) {
    if (std::invoke(counts, *run)) {
      total = total.value_or(0) + static_cast<double>(std::invoke(read, *run));
    }
  }
  return total;
}

/// The same as a table cell.
template <class Counts, class Read>
std::function<std::string(const Group&)> count_of(Counts counts, Read read) {
  return [counts, read](const Group& group) { return number(counted(group, counts, read), 0); };
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

/// Mean number of agents that received such a message.
std::function<std::string(const Group&)> reach_of(std::uint64_t RunResult::*sent,
                                                  std::uint64_t RunResult::*received) {
  return [sent, received](const Group& group) {
    const double all = sum(of_runs(group, [sent](const RunResult& run) { return run.*sent; }));
    const double reached =
        sum(of_runs(group, [received](const RunResult& run) { return run.*received; }));
    return number(all > 0 ? std::optional(reached / all) : std::nullopt, 2);
  };
}

/// A value of the table `run` per simulated second.
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

std::vector<ComparisonFigure> run_figures() {
  const auto time = [](const Group& g) {
    return of_runs(g, [](const RunResult& run) { return run.number("simulated_s"); });
  };
  return {
      {"runs", std::to_string(paper::kRuns),
       [](const Group& g) { return std::to_string(g.runs.size()); }, paper::Basis::kStated},
      {"runs left out (broken off, copies)", "",
       [](const Group& g) { return std::to_string(g.left_out); }},
      {"results", "", results_of},
      {"run time, mean s", "", [time](const Group& g) { return number(mean(time(g)), 1); }},
      {"run time, range s", "", [time](const Group& g) { return range_of(time(g), 1); }},
      {"real-time factor", "> 1", real_time_factor, paper::Basis::kStated},
      {"exchanges per s", "", [](const Group& g) { return per_second(g, "exchanges"); }},
      {"events per s", "", [](const Group& g) { return per_second(g, "events"); }},
  };
}

std::vector<ComparisonFigure> drive_figures() {
  const auto path = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) { return std::optional(d.path); });
  };
  const auto ratio = [](const Group& g) {
    return of_drives(g, [](const RobotDrive& d) { return d.ratio(); });
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
       [contacts](const Group& g) -> std::string {
         const auto all = contacts(g);
         return all.empty() ? "-" : number(sum(all), 0);
       }},
  };
}

/// Without routing, a message to everyone is a single frame and counts as a broadcast.
bool may_flood(const RunResult& run) { return run.counts_messages() && run.has_routing(); }

std::vector<ComparisonFigure> message_figures() {
  const auto counts = &RunResult::counts_messages;
  const auto routes = &RunResult::has_routing;
  const auto found = [](const RunResult& run) { return run.discoveries_ns.size(); };
  return {
      {"messages to one agent", "", count_of(counts, &RunResult::messages)},
      {"delivered %", "", [](const Group& g) { return number(delivery_ratio(g), 2); }},
      {"floods", "", count_of(may_flood, &RunResult::floods)},
      {"agents reached per flood", "", reach_of(&RunResult::floods, &RunResult::flood_deliveries)},
      {"broadcasts to neighbours", "", count_of(counts, &RunResult::broadcasts)},
      {"agents reached per broadcast", "",
       reach_of(&RunResult::broadcasts, &RunResult::broadcast_deliveries)},
      {"routes found", "", count_of(routes, found)},
      {"routes given up", "", count_of(routes, &RunResult::discoveries_failed)},
  };
}

/// Reads a quantile of a sample of a group.
std::function<std::optional<double>(const Group&)> value_of(std::vector<double> (Group::*sample)()
                                                                const,
                                                            double Quantiles::*member) {
  return [sample, member](const Group& group) -> std::optional<double> {
    const auto ours = quantiles((group.*sample)());
    return ours ? std::optional((*ours).*member) : std::nullopt;
  };
}

/// Six lines: minimum (in ns and in ms), quartiles and maximum.
std::vector<ComparisonFigure> quantile_figures(const std::string& name, const Quantiles& theirs,
                                               std::vector<double> (Group::*sample)() const) {
  using paper::Basis;
  const auto line = [&](const char* which, double Quantiles::*member,
                        Basis basis) -> ComparisonFigure {
    const auto value = value_of(sample, member);
    return {fmt::format("{}, {} ms", name, which),
            milliseconds(theirs.*member),
            [value](const Group& group) {
              const auto ours = value(group);
              return ours ? milliseconds(*ours) : std::string("-");
            },
            basis,
            theirs.*member,
            value};
  };
  const auto least = value_of(sample, &Quantiles::min);
  return {{name + ", minimum ns", number(theirs.min * 1e9, 0),
           [least](const Group& group) {
             const auto ours = least(group);
             return ours ? number(*ours * 1e9, 0) : std::string("-");
           },
           Basis::kInferred, theirs.min, least, true},
          line("minimum", &Quantiles::min, Basis::kInferred),
          line("quartile 1", &Quantiles::q1, Basis::kCalibrated),
          line("median", &Quantiles::median, Basis::kCalibrated),
          line("quartile 3", &Quantiles::q3, Basis::kCalibrated),
          line("maximum", &Quantiles::max, Basis::kStated)};
}

/// Mean number of packets per run of each mote, in ascending order.
std::vector<double> packets_of_motes(const Group& group) {
  std::vector<double> values;
  if (group.runs.empty()) return values;
  const auto packets = group.packets();
  const auto runs = static_cast<double>(group.runs.size());
  for (const RunResult::Agent& agent : group.runs.front()->agents) {
    if (!agent.is_robot) values.push_back(static_cast<double>(packets.at(agent.agent)) / runs);
  }
  std::sort(values.begin(), values.end());
  return values;
}

std::optional<double> most_packets(const Group& group) {
  const auto values = packets_of_motes(group);
  return values.empty() ? std::nullopt : std::optional(values.back());
}

std::optional<double> least_packets(const Group& group) {
  const auto values = packets_of_motes(group);
  return values.empty() ? std::nullopt : std::optional(values.front());
}

std::optional<double> packets_ratio(const Group& group) {
  const auto values = packets_of_motes(group);
  if (values.empty() || values.front() <= 0) return std::nullopt;
  return values.back() / values.front();
}

/// Packets per run, so that groups with any number of runs are comparable with the paper's ten
/// runs.
std::vector<ComparisonFigure> packet_figures() {
  const auto line = [](const char* name, double theirs, int decimals,
                       std::optional<double> (*value)(const Group&)) -> ComparisonFigure {
    return {name,
            number(theirs, decimals),
            [value, decimals](const Group& g) { return number(value(g), decimals); },
            paper::Basis::kCalibrated,
            theirs,
            value,
            true};
  };
  return {
      line("packets per run, most of a mote", paper::kMostPackets / paper::kRuns, 1, most_packets),
      line("packets per run, least of a mote", paper::kLeastPackets / paper::kRuns, 1,
           least_packets),
      line("packets, ratio", paper::kMostPackets / paper::kLeastPackets, 2, packets_ratio)};
}

}  // namespace

std::vector<ComparisonFigure> comparison_figures(bool has_paper) {
  std::vector<ComparisonFigure> all = run_figures();
  for (const auto& part :
       {drive_figures(), message_figures(),
        quantile_figures("discovery", paper::kDiscovery, &Group::discoveries),
        quantile_figures("delay", paper::kDelay, &Group::delays), packet_figures()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  if (!has_paper) return all;
  all.push_back({"replica score", "0",
                 [](const Group& g) -> std::string {
                   if (!g.is_the_papers()) return "-";
                   return number(replica_score(quantiles(g.discoveries()), quantiles(g.delays())),
                                 3);
                 },
                 paper::Basis::kCalibrated});
  return all;
}

}  // namespace results::report
