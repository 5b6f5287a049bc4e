#include "results/fleet/fleet_csv.h"

#include <fmt/format.h>

#include "results/report/csv.h"

namespace results::fleet {
namespace {

std::string number(const std::optional<Estimate>& value) {
  return value ? fmt::format("{}", value->value) : "";
}

std::string low(const std::optional<Estimate>& value) {
  return value && value->interval ? fmt::format("{}", value->interval->low) : "";
}

std::string high(const std::optional<Estimate>& value) {
  return value && value->interval ? fmt::format("{}", value->interval->high) : "";
}

std::string names_of(const FleetFile& fleet, const FleetLine& line) {
  return fmt::format("{},{},{}", report::csv_text(fleet.radios[line.radio].name),
                     report::csv_text(fleet.sites[line.site].name),
                     report::csv_text(fleet.profiles[line.profile].name));
}

}  // namespace

std::string fleet_csv(const FleetFile& fleet, const std::vector<FleetLine>& lines) {
  std::string text =
      "radio,site,profile,robots,holds,topic,delivered,delivered_low,delivered_high,first_try,"
      "p50_s,p50_low_s,p50_high_s,p95_s,p95_low_s,p95_high_s,p99_s,age95_s,discovered_s,samples,"
      "runs,failed,busy,wall_s\n";
  for (const FleetLine& line : lines) {
    for (const CaseAnswer& one : line.cases) {
      for (const auto& [topic, samples] : one.topics) {
        text +=
            names_of(fleet, line) +
            fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{:.3f}\n",
                        one.which.robots, one.holds() ? 1 : 0, report::csv_text(topic),
                        number(samples.delivered), low(samples.delivered), high(samples.delivered),
                        number(samples.first_try), number(samples.p50), low(samples.p50),
                        high(samples.p50), number(samples.p95), low(samples.p95), high(samples.p95),
                        number(samples.p99), number(samples.age), number(samples.discovered),
                        samples.samples, one.runs, one.failed, number(one.busy), one.wall_s);
      }
    }
  }
  return text;
}

}  // namespace results::fleet
