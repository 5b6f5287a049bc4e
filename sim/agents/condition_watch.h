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

/// Follows conditions through a run, and tells when they begin to hold.
///
/// Looked at are: states and messages at once; times, and the end of a `hold`, in the event of
/// their time before all else; distances and areas after each physics step, or as often if there
/// are no bodies; batteries at the control instants of their agents. What no condition speaks of
/// costs nothing. One thread.
///
///   ConditionWatch watch({events, position, charge, step});
///   const auto number = watch.add(condition, [] { … });   // may only schedule
///   observers.add(watch); watch.start(); … run …
///   watch.holds(number);
class ConditionWatch final : public Observer {
 public:
  struct Sight {
    EventQueue& events;
    /// m, world frame, now; none: it is not present.
    std::function<std::optional<hal::Vec2>(hal::AgentId)> position;
    /// Of the agent's first battery now, 0 .. 1; none: it has none, or is not present.
    std::function<std::optional<double>(hal::AgentId)> charge;
    hal::Duration look_every{};  ///< At distances and areas, > 0.
  };

  explicit ConditionWatch(Sight sight) : sight_(std::move(sight)) {}

  /// Asks nothing of `sight` yet. @param begins  called at each instant at which the condition
  /// begins to hold, in the middle of whatever made it so: to be noted, and done in an event.
  /// @return its number.
  std::size_t add(const Condition& condition, std::function<void()> begins = {});

  bool empty() const { return watched_.empty(); }
  /// Before the first event of the run.
  void start();

  /// Its controller is gone: the state that it was in counts no more.
  void forget_state(hal::AgentId agent);
  /// It takes no part any more: nothing but `not` holds of it. Its messages have been counted.
  void on_removed(hal::AgentId agent);
  /// At the end of the run: looks at all of them once more, so that what begins to hold with the
  /// last instant counts. Schedules nothing, tells nobody.
  void look_at_the_end();

  bool holds(std::size_t number) const { return watched_[number].holds; }
  bool has_held(std::size_t number) const { return watched_[number].has_held; }

  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_message_delivered(hal::Time at, hal::AgentId receiver, const hal::Message& message,
                            int transmissions) override;
  void on_cycle(hal::Time at, hal::AgentId agent) override;

 private:
  /// A condition and those that it is made of.
  struct Node {
    const Condition* condition = nullptr;
    std::vector<Node> parts;
    bool held = false;  ///< Apart from `hold`, when it was looked at last …
    hal::Time since{};  ///< … and since when.
  };
  /// What makes it worth while to look at one again.
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
  std::deque<Watched> watched_;  ///< Addresses stay: nodes point into it.
  std::map<hal::AgentId, std::string> states_;
  std::map<std::pair<hal::AgentId, std::string>, std::int64_t> received_;  ///< By agent, class.
  /// Of those that are asked about; none: it is not present.
  std::map<hal::AgentId, std::optional<double>> charges_;
  bool needs_messages_ = false, needs_places_ = false, is_over_ = false;
};

}  // namespace sim::agents
