#include <fmt/format.h>

#include "results/report/air_sums.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

std::string percent(std::int64_t part, std::int64_t whole) {
  if (whole == 0) return "-";
  return number(100.0 * static_cast<double>(part) / static_cast<double>(whole), 2);
}

std::string milliseconds_or_none(const std::optional<double>& seconds) {
  return seconds ? milliseconds(*seconds) : "-";
}

std::string topics_text(const Group& group, std::int64_t all) {
  TextTable table({"topic", "samples", "delivered", "first try", "repaired", "latency p50 ms",
                   "p99 ms", "air time s", "share %"});
  for (const TopicSums& one : topic_sums(group)) {
    table.add_row(
        {one.topic.empty() ? "(not announced)" : one.topic, std::to_string(one.samples),
         std::to_string(one.delivered), std::to_string(one.first_try), std::to_string(one.repaired),
         milliseconds_or_none(latency_quantile(one.latencies, 0.5)),
         milliseconds_or_none(latency_quantile(one.latencies, 0.99)),
         number(static_cast<double>(one.airtime_ns) * 1e-9, 6), percent(one.airtime_ns, all)});
  }
  return table.text();
}

std::string kind_text(const RunResult::AirKind& kind) {
  return kind.port ? fmt::format("{} {}:{}", kind.purpose, kind.kind, *kind.port)
                   : fmt::format("{} {}", kind.purpose, kind.kind);
}

std::string kinds_text(const std::vector<RunResult::AirKind>& kinds, std::int64_t all) {
  TextTable table(
      {"what", "frames", "of these retries", "submessages", "bytes", "air time s", "share %"});
  for (const RunResult::AirKind& one : kinds) {
    table.add_row({kind_text(one), std::to_string(one.frames), std::to_string(one.retries),
                   std::to_string(one.submessages), std::to_string(one.bits / 8),
                   number(static_cast<double>(one.airtime_ns) * 1e-9, 6),
                   percent(one.airtime_ns, all)});
  }
  return table.text();
}

}  // namespace

std::string air_section(const Group& group) {
  const std::vector<RunResult::AirKind> kinds = kind_sums(group);
  if (kinds.empty()) return {};
  const std::int64_t all = airtime_of(kinds);
  return fmt::format(
      "{}: topics of programs, samples times receivers, total of {} runs\n{}{}: use of the air by "
      "kind of traffic, largest first\n{}",
      group.name, group.runs.size(), topics_text(group, all), group.name, kinds_text(kinds, all));
}

}  // namespace results::report
