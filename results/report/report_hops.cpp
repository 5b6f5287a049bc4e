#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

/// Shortest delays that the paper's MAC allows (profile mobility_framework with its defaults: 11
/// Mb/s, RTS/CTS, frames of 272 bits, packets without length). First hop: DIFS, RTS, SIFS, CTS,
/// SIFS, DATA. Each further hop also waits for SIFS and the ACK of the previous hop.
constexpr double kFirstHopNs =
    50e3 + (192e3 + 160e3 / 11) + 10e3 + (192e3 + 112e3 / 11) + 10e3 + (192e3 + 272e3 / 11);
constexpr double kNextHopNs = 10e3 + (192e3 + 112e3 / 11) + kFirstHopNs;
/// Tolerance per hop: the times of its frames are rounded to whole nanoseconds.
constexpr double kRoundingNs = 10;

double edge(int hops) { return kFirstHopNs + (hops - 1) * kNextHopNs; }

struct OfHops {
  std::uint64_t count = 0;
  std::optional<std::int64_t> least_ns;
  std::uint64_t too_early = 0;  ///< Listed deliveries that were faster than the MAC allows.
};

void add_sums(const RunResult& run, std::map<int, OfHops>& table) {
  for (const auto& [hops, sums] : run.hops) {
    if (hops == 0) continue;
    OfHops& entry = table[hops];
    entry.count += sums.messages;
    const auto least = sums.least_delay_ns;
    if (least) entry.least_ns = std::min(*least, entry.least_ns.value_or(*least));
  }
}

std::map<int, OfHops> by_hops(const Group& group) {
  std::map<int, OfHops> table;
  for (const RunResult* run : group.runs) {
    add_sums(*run, table);
    for (const RunResult::Delivery& delivery : run->deliveries) {
      const int hops = delivery.transmissions.value_or(0);
      if (hops == 0) continue;
      const auto ns = static_cast<double>(delivery.delay_ns);
      if (ns < edge(hops) - hops * kRoundingNs) ++table[hops].too_early;
    }
  }
  return table;
}

}  // namespace

std::string hops_section(const Group& group) {
  const bool has_edges = group.runs.front()->value("profile") == "mobility_framework";
  const bool all_listed =
      std::ranges::all_of(group.runs, [](const RunResult* run) { return run->lists_deliveries(); });
  TextTable table(has_edges ? std::vector<std::string>{"transmissions", "messages", "least ns",
                                                       "lower edge ns", "below it"}
                            : std::vector<std::string>{"transmissions", "messages", "least ns"});
  for (const auto& [hops, entry] : by_hops(group)) {
    std::vector<std::string> row = {std::to_string(hops), std::to_string(entry.count),
                                    entry.least_ns ? std::to_string(*entry.least_ns) : "-"};
    if (has_edges) {
      row.push_back(number(edge(hops), 0));
      row.push_back(all_listed ? std::to_string(entry.too_early) : "-");
    }
    table.add_row(row);
  }
  return group.name + ": end-to-end delay by transmissions\n" + table.text();
}

}  // namespace results::report
