#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hal/api/controller.h"
#include "hal/api/real_world_object.h"

namespace controllers {

/// The address of the agent that a parameter names.
/// @throws std::invalid_argument  no agent has that name.
inline hal::AgentId agent_called(const hal::RealWorldObject& self, const std::string& name,
                                 const std::string& parameter) {
  const auto address = self.address_of(name);
  if (!address) throw std::invalid_argument(parameter + ": there is no agent '" + name + "'");
  return *address;
}

/// @throws std::invalid_argument  describing the first of these mistakes, if there are any.
inline void refuse(const std::vector<hal::ParameterMistake>& mistakes) {
  if (mistakes.empty()) return;
  throw std::invalid_argument(mistakes.front().name + ": " + mistakes.front().what);
}

}  // namespace controllers
