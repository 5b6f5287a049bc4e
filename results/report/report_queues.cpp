#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>

#include "results/report/relay_sums.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

/// A queue over all runs of a group.
struct QueueSums {
  std::string agent, receiver;
  RunResult::Queue all{};

  void add(const RunResult& run, const RunResult::Queue& one) {
    agent = name_of(run, one.agent);
    receiver = name_of(run, one.receiver);
    all.frames += one.frames;
    all.waiting += one.waiting;
    all.most = std::max(all.most, one.most);
    all.most_bytes = std::max(all.most_bytes, one.most_bytes);
    all.waited_ns += one.waited_ns;
    for (const auto& [verdict, count] : one.drops) all.drops[verdict] += count;
  }
  std::uint64_t dropped(const std::string& verdict) const {
    const auto found = all.drops.find(verdict);
    return found == all.drops.end() ? 0 : found->second;
  }
  std::uint64_t dropped() const {
    std::uint64_t sum = 0;
    for (const auto& [verdict, count] : all.drops) sum += count;
    return sum;
  }
};

std::vector<std::string> row_of(const QueueSums& one, const std::string& category) {
  const std::uint64_t full = one.dropped("queue full"), delay = one.dropped("queue delay"),
                      expired = one.dropped("expired");
  const double wait = static_cast<double>(one.all.waited_ns) * 1e-9;
  return {one.agent,
          one.receiver,
          category,
          std::to_string(one.all.frames),
          one.all.frames == 0 ? "-" : milliseconds(wait / static_cast<double>(one.all.frames)),
          std::to_string(one.all.most),
          std::to_string(one.all.most_bytes),
          std::to_string(one.all.waiting),
          std::to_string(full),
          std::to_string(delay),
          std::to_string(expired),
          std::to_string(one.dropped() - full - delay - expired)};
}

}  // namespace

std::string queues_section(const Group& group) {
  std::map<std::tuple<int, int, std::string>, QueueSums> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::Queue& one : run->queues) {
      sums[{one.agent, one.receiver, one.category}].add(*run, one);
    }
  }
  if (sums.empty()) return {};
  TextTable table({"agent", "to", "category", "frames", "mean wait ms", "most at once",
                   "most bytes", "waiting", "queue full", "queue delay", "expired", "other"});
  for (const auto& [key, one] : sums) table.add_row(row_of(one, std::get<2>(key)));
  return fmt::format("{}: queues for receivers and access categories, total of {} runs\n{}",
                     group.name, group.runs.size(), table.text());
}

}  // namespace results::report
