#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hal/node/exchange/step.h"

namespace gateway::runtime {

/// Collects the actions of one Reply in the order of the controllers' calls.
class Outbox {
 public:
  /// From now on, actions answer this event of this agent.
  void answer(hal::AgentId agent, std::uint32_t event) {
    agent_ = agent;
    event_ = event;
  }

  /// Appends an action. The reference is valid until the next call.
  template <class What>
  What& add(What what) {
    hal::node::exchange::Action& action = actions_.emplace_back();
    action.agent = agent_;
    action.event = event_;
    return action.what.template emplace<What>(std::move(what));
  }

  /// The action that was added last. @pre there is one that has not been taken.
  const hal::node::exchange::Action& last() const { return actions_.back(); }
  void take_back() { actions_.pop_back(); }

  std::vector<hal::node::exchange::Action> take() {
    std::vector<hal::node::exchange::Action> taken = std::exchange(actions_, {});
    actions_.reserve(taken.size());  // the next Reply often has the same length
    return taken;
  }

 private:
  hal::AgentId agent_;
  std::uint32_t event_ = 0;
  std::vector<hal::node::exchange::Action> actions_;
};

}  // namespace gateway::runtime
