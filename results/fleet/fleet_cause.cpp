#include "results/fleet/fleet_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace results::fleet {
namespace {

struct LossKind {
  std::string_view verdict;  ///< Of the table sample_losses.
  Cause cause;
};

constexpr std::array kLossKinds = {
    LossKind{"queue full", Cause::kQueue},
    LossKind{"queue delay", Cause::kQueue},
    LossKind{"expired", Cause::kQueue},
    LossKind{"below sensitivity", Cause::kRange},
    LossKind{"noise", Cause::kRange},
    LossKind{"obstacle", Cause::kRange},
    LossKind{"preamble missed", Cause::kRange},
    LossKind{"random loss", Cause::kRange},
    LossKind{"retry limit", Cause::kRange},
    LossKind{"collision", Cause::kCollision},
    LossKind{"interference", Cause::kCollision},
    LossKind{"receiver transmitting", Cause::kCollision},
    LossKind{"not matched", Cause::kDiscovery},
    LossKind{kUndiscovered, Cause::kDiscovery},
    LossKind{kUnwritten, Cause::kQueue},
    LossKind{kUnderWay, Cause::kQueue},
    LossKind{"no route", Cause::kHandover},
};

/// "queue full at ap" is a queue's.
Cause cause_of_loss(std::string_view why) {
  for (const LossKind& kind : kLossKinds) {
    if (why.starts_with(kind.verdict)) return kind.cause;
  }
  return Cause::kOther;
}

std::string_view name_of_loss(std::string_view why) { return why.substr(0, why.find(" at ")); }

std::uint64_t total(const std::map<std::string, std::uint64_t>& lost) {
  std::uint64_t sum = 0;
  for (const auto& [why, count] : lost) sum += count;
  return sum;
}

/// The cause of most losses, and its words: "81 % of the lost samples: queue full, most at ap".
std::pair<Cause, std::string> main_loss(const SampleAnswer& need) {
  std::map<Cause, std::uint64_t> sums;
  for (const auto& [why, count] : need.lost) sums[cause_of_loss(why)] += count;
  if (sums.empty()) return {Cause::kOther, ""};
  const auto most = std::ranges::max_element(sums, {}, [](const auto& one) { return one.second; });
  const std::pair<const std::string, std::uint64_t>* largest = nullptr;
  for (const auto& one : need.lost) {
    if (cause_of_loss(one.first) != most->first) continue;
    if (largest == nullptr || one.second > largest->second) largest = &one;
  }
  const double share = static_cast<double>(most->second) / static_cast<double>(total(need.lost));
  const std::string_view verdict = name_of_loss(largest->first);
  const std::string_view place = std::string_view(largest->first).substr(verdict.size());
  return {most->first, fmt::format("{} of the lost samples: {}{}", share_text(share), verdict,
                                   place.empty() ? "" : fmt::format(", most{}", place))};
}

std::string busy_text(const CaseAnswer& answer) {
  if (!answer.busy) return "";
  std::string text = answer.busiest.empty()
                         ? std::string("the medium is idle")
                         : fmt::format("the medium at {} is busy {} of the time", answer.busiest,
                                       share_text(answer.busy->value));
  if (answer.backlogged && !answer.most_backlogged.empty()) {
    text += fmt::format(", {} has frames to send in {}", answer.most_backlogged,
                        share_text(answer.backlogged->value));
  }
  return text;
}

bool is_full(const CaseAnswer& answer) {
  return answer.busy && answer.busy->value >= kBusy && answer.backlogged &&
         answer.backlogged->value >= kSaturated;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!part.empty()) text.append(text.empty() ? "" : "; ").append(part);
  }
  return text;
}

/// Samples that do not arrive.
void explain_losses(const CaseAnswer& answer, const SampleAnswer& need, Miss& miss) {
  auto [cause, words] = main_loss(need);
  if (cause == Cause::kHandover && answer.handovers == 0) {
    cause = answer.unassociated > 0 ? Cause::kNoAccessPoint : Cause::kOther;
  }
  miss.cause = is_full(answer) && cause != Cause::kNoAccessPoint ? Cause::kAirFull : cause;
  std::vector<std::string> parts{busy_text(answer), words};
  if (answer.handovers > 0) {
    parts.push_back(fmt::format("{:.1f} handovers in a run", answer.handovers));
  }
  miss.evidence = joined(parts);
}

/// Samples that arrive late.
void explain_delay(const CaseAnswer& answer, const SampleAnswer& need, Miss& miss) {
  constexpr double kMany = 0.05;  // of the samples behind a 95 % quantile
  const double repaired =
      need.samples == 0 ? 0
                        : static_cast<double>(need.repaired) / static_cast<double>(need.samples);
  std::vector<std::string> parts{busy_text(answer)};
  if (is_full(answer)) {
    miss.cause = Cause::kAirFull;
  } else if (repaired >= kMany) {
    miss.cause = Cause::kRepairs;
  } else if (answer.handovers > 0) {
    miss.cause = Cause::kHandover;
    parts.push_back(fmt::format("{:.1f} handovers in a run", answer.handovers));
  } else if (answer.backlogged && answer.backlogged->value >= kMany) {
    miss.cause = Cause::kQueue;
  }
  parts.push_back(fmt::format("DDS repaired {} of the samples", share_text(repaired)));
  miss.evidence = joined(parts);
}

void explain_silence(const CaseAnswer& answer, const SampleAnswer& need, Miss& miss) {
  miss.cause = need.pairs == 0 ? Cause::kOther : Cause::kDiscovery;
  if (is_full(answer)) miss.cause = Cause::kAirFull;
  if (answer.unassociated > 0) miss.cause = Cause::kNoAccessPoint;
  miss.evidence = joined(
      {busy_text(answer),
       need.pairs == 0    ? "no writer and reader of it were announced"
       : need.silent == 0 ? ""
                          : fmt::format("{} of {} pairs of writer and reader never had a sample",
                                        need.silent, need.pairs),
       answer.unassociated > 0
           ? fmt::format("{:.1f} stations had no access point", answer.unassociated)
           : ""});
}

/// Readers whose newest sample is old, or latencies: for want of samples, or because they are late.
void explain_age(const CaseAnswer& answer, const SampleAnswer& need, Miss& miss) {
  constexpr double kMany = 0.05;
  const bool is_lossy = need.delivered && need.delivered->value < 1 - kMany;
  (is_lossy ? explain_losses : explain_delay)(answer, need, miss);
}

/// A limit of a need, and what the case has there.
struct Limit {
  const char* name;
  std::optional<double> asked;
  const std::optional<Estimate>* found;
  bool is_least;
  bool is_share;
  void (*explain)(const CaseAnswer&, const SampleAnswer&, Miss&);
};

std::vector<Limit> limits_of(const Need& need, const SampleAnswer& found) {
  const auto seconds = [](const std::optional<hal::Duration>& limit) {
    return limit ? std::optional(hal::to_seconds(*limit)) : std::nullopt;
  };
  return {
      {"delivered", need.delivered, &found.delivered, true, true, explain_losses},
      {"discovered", seconds(need.discovered), &found.discovered, false, false, explain_silence},
      {"median latency", seconds(need.p50), &found.p50, false, false, explain_delay},
      {"95 % latency", seconds(need.p95), &found.p95, false, false, explain_delay},
      {"99 % latency", seconds(need.p99), &found.p99, false, false, explain_delay},
      {"age", seconds(need.age), &found.age, false, false, explain_age}};
}

bool is_met(const Limit& limit, const SampleAnswer& found) {
  const std::optional<Estimate>& value = *limit.found;
  // What was not sent need not arrive: /tf_static, after its first sample.
  const std::size_t runs = (value ? value->runs : 0) + found.unsent;
  if (runs < found.runs) return false;
  if (!value) return true;
  return limit.is_least ? value->value >= *limit.asked : value->value <= *limit.asked;
}

std::string said(const Limit& limit, const SampleAnswer& found) {
  const auto text = [&](double value) {
    return limit.is_share ? share_text(value) : time_text(value);
  };
  const std::string asked = text(*limit.asked);
  const std::optional<Estimate>& value = *limit.found;
  if (!value) return fmt::format("{}: nothing arrived, asked {}", limit.name, asked);
  const std::size_t without = found.runs - found.unsent - value->runs;
  return fmt::format("{} {}{}, asked {}", limit.name, text(value->value),
                     without == 0 ? "" : fmt::format(", nothing arrived in {} runs", without),
                     asked);
}

}  // namespace

std::string_view name(Cause cause) {
  switch (cause) {
    case Cause::kAirFull:
      return "the air is full";
    case Cause::kQueue:
      return "queues";
    case Cause::kDiscovery:
      return "discovery";
    case Cause::kRange:
      return "weak signals and their retries";
    case Cause::kCollision:
      return "collisions";
    case Cause::kHandover:
      return "handovers";
    case Cause::kNoAccessPoint:
      return "no access point";
    case Cause::kRepairs:
      return "repairs by DDS";
    case Cause::kOther:
      return "other";
  }
  return {};
}

std::string share_text(double share) {
  // Never rounded up to all, or down to none.
  const double percent = 100 * share;
  if (share < 1 && percent >= 99.95) return ">99.9 %";
  if (share > 0 && percent < 0.05) return "<0.1 %";
  return fmt::format("{:.1f} %", percent);
}

std::string time_text(double seconds) {
  if (seconds == 0) return "0 s";
  if (seconds < 1e-3) return fmt::format("{:.3g} us", 1e6 * seconds);
  if (seconds < 1) return fmt::format("{:.3g} ms", 1e3 * seconds);
  return fmt::format("{:.3g} s", seconds);
}

std::vector<Miss> misses_of(const FleetFile& fleet, const CaseAnswer& answer) {
  std::vector<Miss> misses;
  for (std::size_t i = 0; i < fleet.needs.size(); ++i) {
    const SampleAnswer& found = answer.needs[i];
    if (found.pairs == 0 || found.silent > 0) {
      misses.push_back({.need = i, .what = "some samples never arrive", .evidence = {}});
      explain_silence(answer, found, misses.back());
      if (found.pairs == 0) misses.back().what = "nobody writes or reads it";
      continue;
    }
    for (const Limit& limit : limits_of(fleet.needs[i], found)) {
      if (!limit.asked || is_met(limit, found)) continue;
      misses.push_back({.need = i, .what = said(limit, found), .evidence = {}});
      limit.explain(answer, found, misses.back());
    }
  }
  return misses;
}

}  // namespace results::fleet
