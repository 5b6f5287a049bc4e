#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// Checks the agents and topics that controllers' parameters name, combinations of parameters, and
/// the topics of `priorities`. A controller with a parameter for a topic has no other topics.
/// Agents whose parameters have mistakes of their own are left out.
class NamesCheck {
 public:
  explicit NamesCheck(const sim::scenario::Scenario& scenario);

  void add(const sim::scenario::Group& group, const hal::ControllerKind& kind);
  /// To be called for a controller whose parameters are not known.
  void add_unknown() { has_unknown_ = true; }

  /// Appends the findings, each once. To be called once, after all groups were added.
  void finish(std::vector<std::string>& mistakes, std::vector<std::string>& warnings);

 private:
  void add(const sim::scenario::Group& group, const hal::ControllerKind& kind,
           const sim::agents::AgentConfig& agent);
  /// Handles one name in a parameter. @param whose  name of the agent that has the parameter.
  void take(const std::string& place, const hal::ParameterSpec& spec, const std::string& named,
            const std::string& whose);
  void check_agent(const std::string& place, const hal::ParameterSpec& spec,
                   const std::string& named, const std::string& whose);
  void warn_of_unheard();
  void check_priorities();
  void note(std::vector<std::string>& lines, std::string line);

  const sim::scenario::Scenario& scenario_;
  std::vector<std::string> agents_;  ///< Names of the agents.
  std::set<std::string> heard_;      ///< Topics that some agent receives.
  /// Key and sent topic, by place in the file.
  std::map<std::string, std::pair<std::string, std::string>> sent_;
  bool has_unknown_ = false;    ///< Some agent may send and receive any topic.
  std::set<std::string> said_;  ///< Findings so far, to note each once.
  std::vector<std::string> mistakes_, warnings_;
};

}  // namespace baraka::run::check
