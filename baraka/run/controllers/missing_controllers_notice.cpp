#include "baraka/run/controllers/missing_controllers_notice.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "gateway/runtime/controller_command.h"
#include "gateway/runtime/plugin.h"
#include "hal/types/pattern.h"

namespace baraka::run::controllers {
namespace {

constexpr std::chrono::seconds kSayEvery{5};

/// The longest common prefix of some names. @pre There is at least one name.
std::string common_beginning(const std::vector<std::string>& names) {
  std::string common = names.front();
  for (const std::string& name : names) {
    const auto [end, ignored] = std::ranges::mismatch(common, name);
    common.erase(end, common.end());
  }
  return common;
}

std::string words_of(const std::string& program) {
  const auto words =
      gateway::runtime::controller_command(program, gateway::runtime::controller_folders());
  return words.empty() ? program : fmt::format("{}", fmt::join(words, " "));
}

}  // namespace

MissingControllersNotice::MissingControllersNotice(
    std::vector<sim::scenario::ProcessPlan> plans,
    const std::vector<hal::node::exchange::AgentOffer>& offers, int domain, hal::Duration wait,
    const hal::Clock& clock)
    : plans_(std::move(plans)), domain_(domain), wait_(wait), clock_(clock) {
  for (const auto& offer : offers) agents_.push_back({offer.session.agent, offer.session.name});
}

void MissingControllersNotice::say(const std::vector<hal::AgentId>& missing) {
  const hal::Time now = clock_.now();
  if (missing.empty() || (said_ && now - *said_ < kSayEvery)) return;
  fmt::print(stderr, "{} for controllers of {} agent{}, {} s for the next to come; type:\n",
             said_ ? "still waiting" : "waiting", missing.size(), missing.size() == 1 ? "" : "s",
             hal::to_seconds(wait_));
  for (const std::string& command : commands(missing)) fmt::print(stderr, "  {}\n", command);
  said_ = now;
}

std::vector<std::string> MissingControllersNotice::commands(
    const std::vector<hal::AgentId>& missing) const {
  std::vector<std::string> lines;
  for (const sim::scenario::ProcessPlan& plan : plans_) {
    std::vector<std::string> wanted;
    for (const auto& [id, name] : agents_) {
      const bool is_its = std::ranges::find(plan.agents, id) != plan.agents.end();
      if (is_its && std::ranges::find(missing, id) != missing.end()) wanted.push_back(name);
    }
    if (wanted.empty()) continue;
    lines.push_back(
        fmt::format("{} --domain {}{}", words_of(plan.program), domain_, agents_option(wanted)));
  }
  return lines;
}

/// The agents as a pattern if one matches exactly these, otherwise as a list.
std::string MissingControllersNotice::agents_option(const std::vector<std::string>& wanted) const {
  const std::string pattern = common_beginning(wanted) + "*";
  const auto fitting = std::ranges::count_if(
      agents_, [&](const Agent& agent) { return hal::matches(pattern, agent.name); });
  if (wanted.size() > 1 && static_cast<std::size_t>(fitting) == wanted.size()) {
    return fmt::format(" --agents '{}'", pattern);
  }
  std::string options;
  for (const std::string& name : wanted) options += " --agents " + name;
  return options;
}

}  // namespace baraka::run::controllers
