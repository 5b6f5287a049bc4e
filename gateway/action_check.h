#pragma once

#include <cstdint>
#include <vector>

#include "hal/exchange/session.h"
#include "hal/exchange/step.h"

namespace gateway {

enum class ActionVerdict {
  kGood,
  kForeign,    ///< For an agent that the process was not granted.
  kMalformed,  ///< Against the rules of hal/exchange/step.h; hal/runtime never sends such a one.
};

/// The agents that a process was granted, found by address.
class GrantedAgents {
 public:
  explicit GrantedAgents(std::vector<hal::exchange::AgentSession> sessions);

  /// Null: not granted.
  const hal::exchange::AgentSession* find(hal::AgentId agent) const;
  const std::vector<hal::exchange::AgentSession>& all() const { return sessions_; }

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<hal::exchange::AgentSession> sessions_;
  std::vector<std::uint32_t> index_;  ///< In sessions_, by address.
};

/// What the server needs to remember of a Step to judge the Reply.
struct Asked {
  hal::AgentId agent;
  hal::Time time{};
};

/// Judges an action as it came over the wire, where anyone may have written it.
/// @param granted  the agents of the process.   @param asked  one per event of the Step.
ActionVerdict judge(const hal::exchange::Action& action, const GrantedAgents& granted,
                    const std::vector<Asked>& asked);

}  // namespace gateway
