#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "sim/scenario/scenario.h"

namespace baraka::run::check {

/// Checks what controllers' parameters name (agents and topics) and what they say together. Those
/// with mistakes of their own are left out.
class NamesCheck {
 public:
  explicit NamesCheck(const sim::scenario::Scenario& scenario);

  void add(const sim::scenario::Group& group, const hal::ControllerKind& kind);
  void add_unknown() { hears_unknown_ = true; }  ///< A controller whose parameters are not known.

  /// Once, after all groups: moves out what was found, each mistake once.
  void finish(std::vector<std::string>& mistakes, std::vector<std::string>& warnings);

 private:
  void add(const sim::scenario::Group& group, const hal::ControllerKind& kind,
           const sim::agents::AgentConfig& agent);
  /// One name that a parameter has. @param whose  name of the agent that has the parameter.
  void take(const std::string& place, const hal::ParameterSpec& spec, const std::string& named,
            const std::string& whose);
  void check_agent(const std::string& place, const hal::ParameterSpec& spec,
                   const std::string& named, const std::string& whose);
  void note(std::vector<std::string>& lines, std::string line);

  const sim::scenario::Scenario& scenario_;
  std::vector<std::string> agents_;                                  ///< Names.
  std::set<std::string> heard_;                                      ///< Topics.
  std::map<std::string, std::pair<std::string, std::string>> sent_;  ///< By place: key and topic.
  bool hears_unknown_ = false;  ///< Somebody may hear any topic.
  std::set<std::string> said_;
  std::vector<std::string> mistakes_, warnings_;
};

}  // namespace baraka::run::check
