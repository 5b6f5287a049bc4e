#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/overloaded.h"

namespace tests {

/// What the actions of one kind ask for, in their order.
template <class What>
std::vector<What> all(const std::vector<hal::node::exchange::Action>& actions) {
  std::vector<What> found;
  for (const hal::node::exchange::Action& action : actions) {
    if (const auto* what = std::get_if<What>(&action.what)) found.push_back(*what);
  }
  return found;
}

/// The name of a state or a value, a line of the log, an error. Empty: of another kind.
inline std::string text_of(const hal::node::exchange::Action::What& what) {
  return std::visit(
      hal::Overloaded{
          [](const hal::node::exchange::SetState& state) { return state.name; },
          [](const hal::node::exchange::Log& line) { return line.text; },
          [](const hal::node::exchange::ControllerFailed& error) { return error.text; },
          [](const hal::node::exchange::Record& record) { return record.name; },
          [](const auto&) { return std::string(); },
      },
      what);
}
inline std::string text_of(const hal::node::exchange::Action& action) {
  return text_of(action.what);
}

}  // namespace tests
