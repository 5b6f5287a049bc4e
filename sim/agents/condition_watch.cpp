#include "sim/agents/condition_watch.h"

#include <algorithm>
#include <cmath>

namespace sim::agents {

/// Value of a condition now, without its `hold`.
struct ConditionWatch::Value {
  ConditionWatch& watch;
  Node& node;
  std::size_t number;

  template <class Holds>
  static bool quantified(const Subjects& who, Holds holds) {
    return who.quantifier == Subjects::Quantifier::kAll ? std::ranges::all_of(who.agents, holds)
                                                        : std::ranges::any_of(who.agents, holds);
  }
  bool is_in(hal::AgentId agent, const std::string& state) const {
    const auto found = watch.states_.find(agent);
    return found != watch.states_.end() && found->second == state;
  }

  bool operator()(const TimeReached& c) const {
    return watch.sight_.events.now() - hal::Time{} >= c.at;
  }
  bool operator()(const InState& c) const {
    return quantified(c.who, [&](hal::AgentId agent) { return is_in(agent, c.state); });
  }
  bool operator()(const ApartBy& c) const {
    const auto a = watch.sight_.position(c.a), b = watch.sight_.position(c.b);
    if (!a || !b) return false;
    const hal::Vec2 apart = *a - *b;
    const double distance = std::sqrt(hal::dot(apart, apart));
    return distance > c.above && distance < c.below;
  }
  bool operator()(const InArea& c) const {
    return quantified(c.who, [&](hal::AgentId agent) {
      const auto position = watch.sight_.position(agent);
      return position && c.area.contains(*position);
    });
  }
  bool operator()(const BatteryLevel& c) const {
    return quantified(c.who, [&](hal::AgentId agent) {
      const std::optional<double>& charge = watch.charges_.at(agent);
      return charge && *charge > c.above && *charge < c.below;
    });
  }
  bool operator()(const CountOf& c) const {
    std::int64_t count = 0;
    for (const hal::AgentId agent : c.who.agents) {
      if (!c.state.empty()) {
        count += is_in(agent, c.state) ? 1 : 0;
        continue;
      }
      const auto received = watch.received_.find({agent, c.topic});
      if (received != watch.received_.end()) count += received->second;
    }
    return count >= c.at_least && count <= c.at_most;
  }
  /// Evaluates every part, because each may have a `hold` to be followed.
  bool operator()(const Combination& c) const {
    std::size_t holding = 0;
    for (Node& part : node.parts) holding += watch.evaluate(part, number) ? 1 : 0;
    if (c.kind == Combination::Kind::kAll) return holding == node.parts.size();
    return (holding > 0) == (c.kind == Combination::Kind::kAny);
  }
};

ConditionWatch::Node ConditionWatch::node_of(const Condition& condition) {
  Node node;
  node.condition = &condition;
  if (const auto* combination = std::get_if<Combination>(&condition.what)) {
    for (const Condition& part : combination->parts) node.parts.push_back(node_of(part));
  }
  return node;
}

void ConditionWatch::learn_needs(const Condition& condition, Watched& watched) {
  Needs& needs = watched.needs;
  if (const auto* combination = std::get_if<Combination>(&condition.what)) {
    for (const Condition& part : combination->parts) learn_needs(part, watched);
  } else if (const auto* count = std::get_if<CountOf>(&condition.what)) {
    needs.states |= !count->state.empty();
    needs.messages |= count->state.empty();
    if (count->state.empty())
      for (const hal::AgentId agent : count->who.agents) received_[{agent, count->topic}] = 0;
  } else if (const auto* battery = std::get_if<BatteryLevel>(&condition.what)) {
    needs.charges = true;
    for (const hal::AgentId agent : battery->who.agents) charges_[agent];
  } else {
    needs.states |= std::holds_alternative<InState>(condition.what);
    needs.places |= std::holds_alternative<ApartBy>(condition.what) ||
                    std::holds_alternative<InArea>(condition.what);
  }
}

std::size_t ConditionWatch::add(const Condition& condition, std::function<void()> begins) {
  Watched& watched = watched_.emplace_back();
  watched.condition = condition;
  watched.begins = std::move(begins);
  watched.root = node_of(watched.condition);
  learn_needs(watched.condition, watched);
  needs_messages_ |= watched.needs.messages;
  needs_places_ |= watched.needs.places;
  return watched_.size() - 1;
}

void ConditionWatch::schedule_times(const Condition& condition, std::size_t number) {
  if (const auto* time = std::get_if<TimeReached>(&condition.what)) {
    sight_.events.schedule(hal::Time{} + time->at, Rank::kScenario, kWorld,
                           [this, number] { look_at(number); });
  } else if (const auto* combination = std::get_if<Combination>(&condition.what)) {
    for (const Condition& part : combination->parts) schedule_times(part, number);
  }
}

void ConditionWatch::start() {
  for (auto& [agent, charge] : charges_) charge = sight_.charge(agent);
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    schedule_times(watched_[i].condition, i);
    look_at(i);
  }
  if (!needs_places_) return;
  sight_.events.schedule(sight_.events.now() + sight_.look_every, Rank::kRadio, kWorld,
                         [this] { look_at_places(); });
}

bool ConditionWatch::evaluate(Node& node, std::size_t number) {
  const bool holds = std::visit(Value{*this, node, number}, node.condition->what);
  const hal::Duration hold = node.condition->hold;
  if (hold <= hal::Duration::zero()) return holds;
  const hal::Time now = sight_.events.now();
  const bool begins = holds && !node.held;
  node.held = holds;
  if (begins) node.since = now;
  if (begins && !is_over_) {
    sight_.events.schedule(now + hold, Rank::kScenario, kWorld,
                           [this, number] { look_at(number); });
  }
  return holds && now - node.since >= hold;
}

void ConditionWatch::look_at(std::size_t number) {
  Watched& watched = watched_[number];
  const bool held = watched.holds;
  watched.holds = evaluate(watched.root, number);
  watched.has_held |= watched.holds;
  if (watched.holds && !held && watched.begins && !is_over_) watched.begins();
}

template <class Needed>
void ConditionWatch::look_at_all(Needed needed) {
  for (std::size_t i = 0; i < watched_.size(); ++i) {
    if (needed(watched_[i].needs)) look_at(i);
  }
}

void ConditionWatch::look_at_places() {
  look_at_all([](const Needs& needs) { return needs.places; });
  sight_.events.schedule(sight_.events.now() + sight_.look_every, Rank::kRadio, kWorld,
                         [this] { look_at_places(); });
}

void ConditionWatch::forget_state(hal::AgentId agent) {
  if (states_.erase(agent) > 0) look_at_all([](const Needs& needs) { return needs.states; });
}

void ConditionWatch::on_removed(hal::AgentId agent) {
  forget_state(agent);
  const auto charge = charges_.find(agent);
  if (charge != charges_.end()) charge->second.reset();
  look_at_all([](const Needs& needs) { return needs.charges || needs.places; });
}

void ConditionWatch::look_at_the_end() {
  is_over_ = true;
  look_at_all([](const Needs&) { return true; });
}

void ConditionWatch::on_state(hal::Time, hal::AgentId agent, std::string_view state) {
  states_[agent] = state;
  look_at_all([](const Needs& needs) { return needs.states; });
}

void ConditionWatch::on_message_delivered(hal::Time, hal::AgentId receiver,
                                          const hal::Message& message, int) {
  if (!needs_messages_) return;
  const auto counted = received_.find({receiver, message.topic});
  if (counted == received_.end()) return;
  ++counted->second;
  look_at_all([](const Needs& needs) { return needs.messages; });
}

void ConditionWatch::on_cycle(hal::Time, hal::AgentId agent) {
  const auto known = charges_.find(agent);
  if (known == charges_.end()) return;
  known->second = sight_.charge(agent);
  look_at_all([](const Needs& needs) { return needs.charges; });
}

}  // namespace sim::agents
