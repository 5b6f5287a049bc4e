#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/agents/condition.h"
#include "sim/agents/observer.h"
#include "sim/core/event_queue.h"

namespace sim::agents {

/// Evaluates conditions during a run and reports when they begin to hold.
///
/// States and messages are evaluated at once; times, and the end of a `hold`, in an event at their
/// time that precedes all others; distances and areas after each physics step, or as often if there
/// are no bodies; batteries at the control instants of their agents. Quantities that no condition
/// uses cost nothing. One thread.
///
///   ConditionWatch watch({events, position, charge, step});
///   const auto number = watch.add(condition, [] { … });   // may only schedule
///   observers.add(watch); watch.start(); … run …
///   watch.holds(number);
class ConditionWatch final : public Observer {
 public:
  struct Sight {
    EventQueue& events;
    /// Position now [m], world frame; nullopt: the agent is not present.
    std::function<std::optional<hal::Vec2>(hal::AgentId)> position;
    /// State of charge of the agent's first battery now, 0 .. 1; nullopt: the agent has no battery
    /// or is not present.
    std::function<std::optional<double>(hal::AgentId)> charge;
    hal::Duration look_every{};  ///< Period for distances and areas, > 0.
  };

  explicit ConditionWatch(Sight sight) : sight_(std::move(sight)) {}

  /// Adds a condition; does not use `sight` yet. @param begins  called each time that the condition
  /// begins to hold, from within the call that caused it: it may only record this and schedule an
  /// event.
  /// @return the condition's number.
  std::size_t add(const Condition& condition, std::function<void()> begins = {});

  bool empty() const { return watched_.empty(); }
  /// Call before the first event of the run.
  void start();

  /// The agent's controller has ended: the agent is in no state until a new one names a state.
  void forget_state(hal::AgentId agent);
  /// The agent has left the run: only negated conditions hold for it. Messages that it received
  /// still count.
  void on_removed(hal::AgentId agent);
  /// Call at the end of the run: evaluates all conditions once more, so that a condition that
  /// begins to hold at the last instant counts. Schedules nothing and calls no callbacks.
  void look_at_the_end();

  bool holds(std::size_t number) const { return watched_[number].holds; }
  bool has_held(std::size_t number) const { return watched_[number].has_held; }

  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_cycle(hal::Time at, hal::AgentId agent) override;

 private:
  /// A condition and the conditions that it combines.
  struct Node {
    const Condition* condition = nullptr;
    std::vector<Node> parts;
    bool held = false;  ///< Without `hold`, at the last evaluation.
    hal::Time since{};  ///< Time since which `held` has had its value.
  };
  /// The changes after which a condition must be evaluated again.
  struct Needs {
    bool states = false, messages = false, places = false, charges = false;
  };
  struct Watched {
    Condition condition;
    std::function<void()> begins;
    Node root;
    Needs needs;
    bool holds = false, has_held = false;
  };
  struct Value;

  Node node_of(const Condition& condition);
  void learn_needs(const Condition& condition, Watched& watched);
  void schedule_times(const Condition& condition, std::size_t number);
  bool evaluate(Node& node, std::size_t number);
  void look_at(std::size_t number);
  void look_at_places();
  template <class Needed>
  void look_at_all(Needed needed);

  Sight sight_;
  std::deque<Watched> watched_;  ///< A deque, because nodes point to its elements.
  std::map<hal::AgentId, std::string> states_;
  std::map<std::pair<hal::AgentId, std::string>, std::int64_t> received_;  ///< By agent and class.
  /// Charges of agents with a condition on their battery; nullopt: not present.
  std::map<hal::AgentId, std::optional<double>> charges_;
  bool needs_messages_ = false, needs_places_ = false, is_over_ = false;
};

}  // namespace sim::agents
