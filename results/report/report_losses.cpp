#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "hal/types/verdict.h"
#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

constexpr std::size_t kWorstLinks = 10;
constexpr std::uint64_t kEnoughFrames = 20;

/// The verdicts in the order of hal::Verdict, then frames without one.
std::vector<std::string> all_verdicts() {
  std::vector<std::string> names;
  names.reserve(hal::kVerdictCount + 1);
  for (int i = 0; i < hal::kVerdictCount; ++i) {
    names.emplace_back(hal::name(static_cast<hal::Verdict>(i)));
  }
  names.emplace_back("under way");
  return names;
}

std::vector<std::string> sums_row(const std::string& name, const FrameSums& sums) {
  return {name, std::to_string(sums.to_it), std::to_string(sums.to_everyone),
          std::to_string(sums.to_others), std::to_string(sums.all())};
}

std::string sums_text(const Group& group) {
  const auto verdicts = group.frame_verdicts();
  TextTable table({"verdict", "to it alone", "to everyone", "to others", "all"});
  FrameSums total;
  for (const std::string& name : all_verdicts()) {
    const auto found = verdicts.find(name);
    if (found == verdicts.end()) continue;
    table.add_row(sums_row(name, found->second));
    total.to_it += found->second.to_it;
    total.to_everyone += found->second.to_everyone;
    total.to_others += found->second.to_others;
  }
  table.add_row(sums_row("frames sent x radios", total));
  return table.text();
}

double share_delivered(const LinkSums& link) {
  return static_cast<double>(link.delivered()) / static_cast<double>(link.sent());
}

/// Losses by verdict, most frequent first: "collision 12, noise 3".
std::string losses_of(const LinkSums& link) {
  std::vector<std::pair<std::uint64_t, std::string>> losses;
  for (const auto& [verdict, count] : link.verdicts) {
    if (verdict != hal::name(hal::Verdict::kDelivered)) losses.emplace_back(count, verdict);
  }
  std::ranges::sort(losses, [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  std::string text;
  for (const auto& [count, verdict] : losses) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", verdict, count);
  }
  return text.empty() ? "-" : text;
}

std::string name_of(const Group& group, int agent) {
  for (const RunResult::Agent& one : group.runs.front()->agents) {
    if (one.agent == agent) return one.name;
  }
  return std::to_string(agent);
}

std::string links_text(const Group& group) {
  std::vector<LinkSums> links = group.link_verdicts();
  std::erase_if(links, [](const LinkSums& link) { return link.sent() < kEnoughFrames; });
  std::ranges::stable_sort(links, {}, share_delivered);
  TextTable table({"from", "to", "sent", "delivered %", "lost"});
  for (std::size_t i = 0; i < std::min(kWorstLinks, links.size()); ++i) {
    table.add_row({name_of(group, links[i].from), name_of(group, links[i].to),
                   std::to_string(links[i].sent()), number(100 * share_delivered(links[i]), 2),
                   losses_of(links[i])});
  }
  return fmt::format(
      "the {} of {} links that lost most, among those with at least {} frames to the receiver or "
      "to everyone (all: baraka export DIR link_verdicts)\n{}",
      std::min(kWorstLinks, links.size()), links.size(), kEnoughFrames, table.text());
}

}  // namespace

std::string losses_section(const Group& group) {
  return fmt::format("{}: outcome of each frame at each other radio, total of {} runs\n{}{}",
                     group.name, group.runs.size(), sums_text(group), links_text(group));
}

}  // namespace results::report
