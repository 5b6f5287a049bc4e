#include <fmt/format.h>

#include <string>
#include <vector>

#include "results/report/queue_sums.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

std::vector<std::string> row_of(const QueueSums& one) {
  const std::uint64_t full = one.dropped("queue full"), delay = one.dropped("queue delay"),
                      expired = one.dropped("expired");
  const double wait = static_cast<double>(one.all.waited_ns) * 1e-9;
  return {one.agent,
          one.receiver,
          one.category,
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
  const std::vector<QueueSums> sums = queue_sums(group);
  if (sums.empty()) return {};
  TextTable table({"agent", "to", "category", "frames", "mean wait ms", "most at once",
                   "most bytes", "waiting", "queue full", "queue delay", "expired", "other"});
  for (const QueueSums& one : sums) table.add_row(row_of(one));
  return fmt::format("{}: queues for receivers and access categories, total of {} runs\n{}",
                     group.name, group.runs.size(), table.text());
}

}  // namespace results::report
