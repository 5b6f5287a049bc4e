#include "baraka/run/check/check_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "baraka/run/check/config_of.h"
#include "gateway/runtime/check_parameters.h"
#include "hal/files/config/suggest.h"

namespace baraka::run::check {
namespace {

using hal::Naming;
using hal::ParameterSpec;
using sim::agents::AgentConfig;
using sim::scenario::Group;

/// The place where the parameter is given or, if it is not, the place of the controller.
std::string place_of(const Group& group, const AgentConfig& agent, const std::string& name) {
  const auto given =
      std::ranges::find(agent.parameters, name, &hal::node::exchange::ParameterText::name);
  return given == agent.parameters.end() ? group.program_place : given->place;
}

std::vector<std::string> texts_of(const ParameterSpec& spec, const hal::Parameters& parameters) {
  if (spec.default_value.kind() == hal::ParameterKind::kTexts) return parameters.texts(spec.name);
  return {parameters.text(spec.name)};
}

bool is_word(const ParameterSpec& spec, const std::string& text) {
  if (std::ranges::find(spec.besides, text) != spec.besides.end()) return true;
  return spec.default_value.kind() == hal::ParameterKind::kText &&
         spec.default_value.text() == text;
}

bool declares_topics(const hal::ControllerKind& kind) {
  return std::ranges::any_of(kind.parameters, [](const ParameterSpec& spec) {
    return spec.names == Naming::kSentTopic || spec.names == Naming::kHeardTopic;
  });
}

}  // namespace

NamesCheck::NamesCheck(const sim::scenario::Scenario& scenario) : scenario_(scenario) {
  for (const AgentConfig& agent : scenario.simulation.agents) agents_.push_back(agent.name);
}

void NamesCheck::add(const Group& group, const hal::ControllerKind& kind) {
  has_unknown_ |= !declares_topics(kind);
  for (const hal::AgentId id : group.agents) {
    const AgentConfig& agent = config_of(scenario_, id);
    if (!gateway::runtime::check_parameters(kind, agent.parameters).empty()) {
      has_unknown_ = true;
      continue;
    }
    add(group, kind, agent);
  }
}

void NamesCheck::add(const Group& group, const hal::ControllerKind& kind,
                     const AgentConfig& agent) {
  const hal::Parameters parameters = gateway::runtime::read_parameters(kind, agent.parameters);
  for (const ParameterSpec& spec : kind.parameters) {
    if (spec.names == Naming::kNothing) continue;
    if (spec.is_used != nullptr && !spec.is_used(parameters)) continue;
    for (const std::string& text : texts_of(spec, parameters)) {
      take(place_of(group, agent, spec.name), spec, text, agent.name);
    }
  }
  if (kind.judge == nullptr) return;
  for (const hal::ParameterMistake& mistake : kind.judge(parameters)) {
    note(mistake.can_work ? warnings_ : mistakes_,
         fmt::format("{}: {}{}: {}", place_of(group, agent, mistake.name),
                     mistake.can_work ? "warning: " : "", mistake.name, mistake.what));
  }
}

void NamesCheck::take(const std::string& place, const ParameterSpec& spec, const std::string& named,
                      const std::string& whose) {
  if (spec.names == Naming::kHeardTopic) {
    heard_.insert(named);
  } else if (spec.names == Naming::kSentTopic) {
    sent_.try_emplace(place, spec.name, named);
  } else {
    check_agent(place, spec, named, whose);
  }
}

void NamesCheck::check_agent(const std::string& place, const ParameterSpec& spec,
                             const std::string& named, const std::string& whose) {
  if (is_word(spec, named)) return;
  if (std::ranges::find(agents_, named) == agents_.end()) {
    std::vector<std::string> allowed = agents_;
    allowed.insert(allowed.end(), spec.besides.begin(), spec.besides.end());
    note(mistakes_, fmt::format("{}: {}: there is no agent '{}'{}", place, spec.name, named,
                                hal::files::config::suggestion(named, allowed)));
  } else if (spec.names == Naming::kOtherAgent && named == whose) {
    note(mistakes_, fmt::format("{}: {}: '{}' is the agent itself", place, spec.name, named));
  }
}

void NamesCheck::note(std::vector<std::string>& lines, std::string line) {
  if (said_.insert(line).second) lines.push_back(std::move(line));
}

void NamesCheck::warn_of_unheard() {
  // If no agent receives any topic, the messages are meant as load on the channel.
  if (heard_.empty() || has_unknown_) return;
  for (const auto& [place, sent] : sent_) {
    const auto& [key, topic] = sent;
    if (heard_.contains(topic)) continue;
    note(warnings_,
         fmt::format("{}: warning: {}: no agent receives the topic '{}'; agents receive: '{}'",
                     place, key, topic, fmt::join(heard_, "', '")));
  }
}

void NamesCheck::check_priorities() {
  std::vector<std::string> topics(heard_.begin(), heard_.end());
  for (const auto& [place, sent] : sent_) topics.push_back(sent.second);
  if (topics.empty() || has_unknown_) return;
  for (const auto& [topic, place] : scenario_.priority_places) {
    if (std::ranges::find(topics, topic) != topics.end()) continue;
    note(mistakes_, fmt::format("{}: priorities.{}: no agent sends or receives this topic{}", place,
                                topic, hal::files::config::suggestion(topic, topics)));
  }
}

void NamesCheck::finish(std::vector<std::string>& mistakes, std::vector<std::string>& warnings) {
  warn_of_unheard();
  check_priorities();
  std::ranges::move(mistakes_, std::back_inserter(mistakes));
  std::ranges::move(warnings_, std::back_inserter(warnings));
}

}  // namespace baraka::run::check
