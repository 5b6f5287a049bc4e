#pragma once

#include <array>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/scenario/tally.h"

namespace results::record {

/// Keeps the values of tally_kinds() for each agent.
class Tallies {
 public:
  /// Called when a value that consists of events has a new event.
  using OnEvent = std::function<void(hal::Time, hal::AgentId, sim::scenario::Tally, double)>;

  /// @param highest  highest address of an agent.
  Tallies(hal::AgentId highest, OnEvent on_event);

  /// None: no event has occurred yet.
  std::optional<double> value(hal::AgentId agent, sim::scenario::Tally tally) const;

  void count(hal::AgentId agent, sim::scenario::Tally tally, double more = 1) {
    place(agent, tally) += more;
  }
  void set(hal::Time at, hal::AgentId agent, sim::scenario::Tally tally, double value) {
    place(agent, tally) = value;
    on_event_(at, agent, tally, value);
  }

  void on_message_sent(hal::Time at, const hal::Message& message);
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message);

 private:
  using MessageKey = std::pair<hal::AgentId, hal::MessageId>;

  double& place(hal::AgentId agent, sim::scenario::Tally tally) {
    return values_[agent.value][static_cast<std::size_t>(tally)];
  }

  std::vector<std::array<double, sim::scenario::kTallies>> values_;  ///< By address.
  OnEvent on_event_;
  std::map<MessageKey, hal::Time> sent_;  ///< Messages of the last kLongestDelay.
  std::deque<std::pair<hal::Time, MessageKey>> sent_order_;  ///< The same, in order of sending.
};

}  // namespace results::record
