#include "sim/agents/condition_watch.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

namespace sim::agents {
namespace {

using namespace std::chrono_literals;
using hal::AgentId;

constexpr AgentId kOne{1}, kTwo{2};

template <class What>
Condition condition_of(What what) {
  Condition condition;
  condition.what = std::move(what);
  return condition;
}

/// Two agents whose places and batteries a test sets.
class Watching : public testing::Test {
 protected:
  Condition any_in(const std::string& state) { return condition_of(InState{any_, state}); }
  Condition all_in(const std::string& state) { return condition_of(InState{all_, state}); }

  /// Watches from the start of the run. Counts how often it begins.
  std::size_t watch(const Condition& condition) {
    const std::size_t number = watch_.add(condition, [this] { ++begun_; });
    watch_.start();
    return number;
  }
  void run_until(hal::Duration end) {
    while (events_.next_time() && *events_.next_time() <= Time{} + end) events_.run_next();
    events_.advance_to(Time{} + end);
  }
  void enter(AgentId agent, const char* state) { watch_.on_state(events_.now(), agent, state); }
  void receive(AgentId agent, const char* topic) {
    hal::Message message;
    message.topic = topic;
    watch_.on_message_delivered(events_.now(), agent, message, 1);
  }

  EventQueue events_;
  std::optional<hal::Vec2> place_of(AgentId agent) const {
    const auto place = places_.find(agent);
    return place == places_.end() ? std::nullopt : std::optional(place->second);
  }

  std::map<AgentId, hal::Vec2> places_;
  std::map<AgentId, double> charges_{{kOne, 0.9}, {kTwo, 0.9}};
  ConditionWatch watch_{{.events = events_,
                         .position = [this](AgentId agent) { return place_of(agent); },
                         .charge = [this](AgentId agent) { return std::optional(charges_[agent]); },
                         .look_every = 10ms}};
  const Subjects any_{Subjects::Quantifier::kAny, "*", {kOne, kTwo}};
  const Subjects all_{Subjects::Quantifier::kAll, "*", {kOne, kTwo}};
  int begun_ = 0;
};

TEST_F(Watching, AStateOfAnyIsSeenAtOnceAlsoIfItLastsNoTime) {
  const auto number = watch(any_in("ARRIVED"));
  enter(kTwo, "ARRIVED");
  EXPECT_TRUE(watch_.holds(number));
  enter(kTwo, "IDLE");
  EXPECT_FALSE(watch_.holds(number));
  EXPECT_TRUE(watch_.has_held(number));
  enter(kOne, "ARRIVED");
  enter(kTwo, "ARRIVED");  // it holds already
  EXPECT_EQ(begun_, 2);
}

TEST_F(Watching, WhoIsRemovedIsNowhereInNoStateAndWithoutCharge) {
  places_ = {{kOne, {0, 0}}, {kTwo, {3, 0}}};
  const Area everywhere{Area::Circle{.centre = {}, .radius = 1e9}};
  const CountOf one_done{.who = any_, .state = "DONE", .topic = {}, .at_least = 1};
  const std::vector numbers{watch_.add(condition_of(ApartBy{.a = kOne, .b = kTwo, .above = 1})),
                            watch_.add(condition_of(InArea{all_, everywhere})),
                            watch_.add(condition_of(BatteryLevel{.who = all_, .above = 0.5})),
                            watch_.add(condition_of(one_done)), watch(any_in("DONE"))};
  enter(kTwo, "DONE");
  for (const auto number : numbers) EXPECT_TRUE(watch_.holds(number)) << number;
  places_.erase(kTwo);
  watch_.on_removed(kTwo);
  for (const auto number : numbers) EXPECT_FALSE(watch_.holds(number)) << number;
}

TEST_F(Watching, TheLastInstantCountsThoughNothingBeginsWithIt) {
  const auto at_the_end = watch_.add(condition_of(TimeReached{2s}));
  Condition for_a_while = condition_of(TimeReached{1900ms});
  for_a_while.hold = 100ms;
  const auto held = watch_.add(for_a_while);
  Condition too_short = condition_of(TimeReached{2s});
  too_short.hold = 1ms;
  const auto not_yet = watch(too_short);
  run_until(1999ms);
  events_.advance_to(Time{2s});
  watch_.look_at_the_end();
  EXPECT_TRUE(watch_.holds(at_the_end));
  EXPECT_TRUE(watch_.has_held(held));
  EXPECT_FALSE(watch_.holds(not_yet));
  EXPECT_EQ(begun_, 0);
}

TEST_F(Watching, AStateOfAllNeedsAll) {
  const auto number = watch(all_in("DONE"));
  enter(kOne, "DONE");
  EXPECT_FALSE(watch_.holds(number));
  enter(kTwo, "DONE");
  EXPECT_TRUE(watch_.holds(number));
}

TEST_F(Watching, ATimeComesAtItsTime) {
  const auto number = watch(condition_of(TimeReached{2s}));
  run_until(1999ms);
  EXPECT_FALSE(watch_.holds(number));
  run_until(2s);
  EXPECT_TRUE(watch_.holds(number));
  EXPECT_EQ(begun_, 1);
}

TEST_F(Watching, WhatMustHoldForAWhileBeginsThen) {
  Condition condition = any_in("WAIT");
  condition.hold = 5s;
  const auto number = watch(condition);
  enter(kOne, "WAIT");
  run_until(4s);
  enter(kOne, "IDLE");
  enter(kOne, "WAIT");  // from the beginning
  run_until(8999ms);
  EXPECT_FALSE(watch_.has_held(number));
  run_until(9s);
  EXPECT_TRUE(watch_.holds(number));
  enter(kOne, "IDLE");
  EXPECT_FALSE(watch_.holds(number));
}

TEST_F(Watching, DistancesAreLookedAtOncePerStep) {
  places_ = {{kOne, {0, 0}}, {kTwo, {30, 40}}};
  const auto near = watch(condition_of(ApartBy{.a = kOne, .b = kTwo, .below = 50}));
  EXPECT_FALSE(watch_.holds(near));
  places_[kTwo] = {30, 39};
  run_until(9ms);
  EXPECT_FALSE(watch_.holds(near));
  run_until(10ms);
  EXPECT_TRUE(watch_.holds(near));
}

TEST_F(Watching, ADistanceMayBeABandOrALowerLimit) {
  places_ = {{kOne, {0, 0}}, {kTwo, {7, 0}}};
  EXPECT_TRUE(
      watch_.holds(watch(condition_of(ApartBy{.a = kOne, .b = kTwo, .above = 5, .below = 10}))));
  EXPECT_FALSE(watch_.holds(watch(condition_of(ApartBy{.a = kOne, .b = kTwo, .above = 7}))));
}

TEST_F(Watching, AreasAreCirclesAndBoxes) {
  places_ = {{kOne, {3, 4}}, {kTwo, {100, 0}}};
  EXPECT_TRUE(watch_.holds(watch(condition_of(InArea{any_, {Area::Circle{{0, 0}, 5}}}))));
  EXPECT_FALSE(watch_.holds(watch(condition_of(InArea{any_, {Area::Circle{{0, 0}, 4.99}}}))));
  EXPECT_FALSE(watch_.holds(watch(condition_of(InArea{all_, {Area::Box{{0, 0}, {10, 10}}}}))));
  EXPECT_TRUE(watch_.holds(watch(condition_of(InArea{all_, {Area::Box{{0, 0}, {100, 10}}}}))));
}

TEST_F(Watching, ABatteryIsSeenAtItsAgentsControlInstants) {
  const auto number = watch(condition_of(BatteryLevel{.who = any_, .below = 0.5}));
  charges_[kTwo] = 0.4;
  run_until(1s);
  EXPECT_FALSE(watch_.holds(number));
  watch_.on_cycle(events_.now(), kOne);
  EXPECT_FALSE(watch_.holds(number));
  watch_.on_cycle(events_.now(), kTwo);
  EXPECT_TRUE(watch_.holds(number));
}

TEST_F(Watching, AgentsInAStateAreCounted) {
  const auto two =
      watch(condition_of(CountOf{.who = any_, .state = "DONE", .topic = {}, .at_least = 2}));
  const auto most =
      watch(condition_of(CountOf{.who = any_, .state = "DONE", .topic = {}, .at_most = 1}));
  EXPECT_TRUE(watch_.holds(most));
  enter(kOne, "DONE");
  EXPECT_FALSE(watch_.holds(two));
  enter(kTwo, "DONE");
  EXPECT_TRUE(watch_.holds(two));
  EXPECT_FALSE(watch_.holds(most));
}

TEST_F(Watching, MessagesOfAClassAreCountedOverAllReceivers) {
  const auto number =
      watch(condition_of(CountOf{.who = any_, .state = {}, .topic = "t", .at_least = 3}));
  receive(kOne, "t");
  receive(kTwo, "t");
  receive(kTwo, "other");
  receive(AgentId{3}, "t");
  EXPECT_FALSE(watch_.holds(number));
  receive(kOne, "t");
  EXPECT_TRUE(watch_.holds(number));
}

TEST_F(Watching, ConditionsAreCombined) {
  using Kind = Combination::Kind;
  const auto both = watch(condition_of(Combination{Kind::kAll, {any_in("A"), any_in("B")}}));
  const auto either = watch(condition_of(Combination{Kind::kAny, {any_in("A"), any_in("B")}}));
  const auto none = watch(condition_of(Combination{Kind::kNone, {any_in("A")}}));
  EXPECT_TRUE(watch_.holds(none));
  enter(kOne, "A");
  EXPECT_FALSE(watch_.holds(both));
  EXPECT_TRUE(watch_.holds(either));
  EXPECT_FALSE(watch_.holds(none));
  enter(kTwo, "B");
  EXPECT_TRUE(watch_.holds(both));
}

TEST(ConditionText, SaysWhatWasAsked) {
  const std::vector<std::pair<AgentId, std::string>> names{{kOne, "a"}, {kTwo, "b"}};
  const Subjects any{Subjects::Quantifier::kAny, "r*", {kOne, kTwo}};
  Condition condition =
      condition_of(Combination{Combination::Kind::kAll,
                               {condition_of(InState{any, "DONE"}),
                                condition_of(ApartBy{.a = kOne, .b = kTwo, .below = 5})}});
  condition.hold = 2s;
  EXPECT_EQ(to_text(condition, names),
            "all of (any of 'r*' in state DONE; distance of a and b below 5 m) for 2 s");
}

}  // namespace
}  // namespace sim::agents
