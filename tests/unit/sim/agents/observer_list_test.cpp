#include "sim/agents/observer_list.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/unit/sim/agents/single_observers.h"

namespace sim::agents {
namespace {

using namespace tests;
using hal::node::agent::AgentObserver;

// What callbacks are called with.

/// Object that nobody looks into, another one for each argument.
template <class T, std::size_t kIndex>
const T& object() {
  alignas(T) static const std::array<std::byte, sizeof(T)> storage{};
  return reinterpret_cast<const T&>(storage);
}

/// An argument, another one at each index.
template <class T, std::size_t kIndex>
T sample() {
  using Value = std::remove_cvref_t<T>;
  static const std::string text(kIndex + 1, 'x');
  static const std::array<double, kIndex + 1> numbers{};
  if constexpr (std::is_reference_v<T>)
    return object<Value, kIndex>();
  else if constexpr (std::is_same_v<T, Time>)
    return Time{} + hal::Duration{kIndex + 1};
  else if constexpr (std::is_same_v<T, std::string_view>)
    return text;
  else if constexpr (std::is_same_v<T, std::span<const double>>)
    return numbers;
  else if constexpr (std::is_same_v<T, AgentId> || std::is_same_v<T, std::optional<AgentId>>)
    return AgentId{kIndex + 1};
  else
    return static_cast<T>(kIndex + 1);
}

/// Calls a callback. @return what with.
template <class Base, class... Arguments>
Call fire(Observer& to, void (Base::*callback)(Arguments...)) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...> /*all*/) {
    const std::tuple<Arguments...> arguments{sample<Arguments, kIndex>()...};
    (to.*callback)(std::get<kIndex>(arguments)...);
    return Call{trace(std::get<kIndex>(arguments))...};
  }
  (std::index_sequence_for<Arguments...>{});
}

struct Callback {
  std::string_view name;
  /// Adds an observer of this callback alone.
  std::unique_ptr<Heard> (*add)(ObserverList& list);
  /// The same as an Observer of which the list does not know more.
  std::unique_ptr<Heard> (*add_as_observer)(ObserverList& list);
  Call (*fire)(Observer& to);
};

template <class Added, class One>
std::unique_ptr<Heard> added(ObserverList& list) {
  auto observer = std::make_unique<One>();
  list.add<Added>(*observer);
  return observer;
}

template <class One, auto kCallback>
constexpr Callback callback(std::string_view name) {
  return {name, added<One, One>, added<Observer, One>,
          [](Observer& to) { return fire(to, kCallback); }};
}

constexpr std::array kCallbacks{
    callback<OfFrameStart, &Observer::on_frame_start>("on_frame_start"),
    callback<OfFaint, &Observer::on_faint>("on_faint"),
    callback<OfFrameCut, &Observer::on_frame_cut>("on_frame_cut"),
    callback<OfSinr, &Observer::on_sinr>("on_sinr"),
    callback<OfReception, &Observer::on_reception>("on_reception"),
    callback<OfDelivered, &Observer::on_delivered>("on_delivered"),
    callback<OfRequestEnd, &Observer::on_request_end>("on_request_end"),
    callback<OfRelayLost, &Observer::on_relay_lost>("on_relay_lost"),
    callback<OfRelayQueued, &Observer::on_relay_queued>("on_relay_queued"),
    callback<OfQueue, &Observer::on_queue>("on_queue"),
    callback<OfMsduEnd, &Observer::on_msdu_end>("on_msdu_end"),
    callback<OfAssociation, &Observer::on_association>("on_association"),
    callback<OfStart, &Observer::on_start>("on_start"),
    callback<OfBody, &Observer::on_body>("on_body"),
    callback<OfMovable, &Observer::on_movable>("on_movable"),
    callback<OfDisplaced, &Observer::on_displaced>("on_displaced"),
    callback<OfBodyLost, &Observer::on_body_lost>("on_body_lost"),
    callback<OfScripted, &Observer::on_scripted>("on_scripted"),
    callback<OfTurn, &Observer::on_turn>("on_turn"),
    callback<OfAirEntered, &Observer::on_air_entered>("on_air_entered"),
    callback<OfAirLeft, &Observer::on_air_left>("on_air_left"),
    callback<OfAirRefused, &Observer::on_air_refused>("on_air_refused"),
    callback<OfArrival, &Observer::on_arrival>("on_arrival"),
    callback<OfCycle, &Observer::on_cycle>("on_cycle"),
    callback<OfPose, &Observer::on_pose>("on_pose"),
    callback<OfReading, &Observer::on_reading>("on_reading"),
    callback<OfEvent, &Observer::on_event>("on_event"),
    callback<OfAction, &Observer::on_action>("on_action"),
    callback<OfMessageSent, &Observer::on_message_sent>("on_message_sent"),
    callback<OfMessageDelivered, &Observer::on_message_delivered>("on_message_delivered"),
    callback<OfFate, &Observer::on_fate>("on_fate"),
    callback<OfMessageEnd, &Observer::on_message_end>("on_message_end"),
    callback<OfDiscovery, &Observer::on_discovery>("on_discovery"),
    callback<OfProtocolEvent, &Observer::on_protocol_event>("on_protocol_event"),
    callback<OfRouteChange, &Observer::on_route_change>("on_route_change"),
    callback<OfState, &Observer::on_state>("on_state"),
    callback<OfRecord, &Observer::on_record>("on_record")};

/// Members that answer a question.
constexpr std::tuple kQuestions{&Observer::observes_readings, &Observer::observes};

/// Virtual functions of a class besides its destructor, without those of a base that is not its
/// first one: by the place that one more would have in the table of virtual functions. A pointer to
/// a virtual member holds its offset there, and the destructor has two places (Itanium C++ ABI,
/// 2.3 and 2.5.2).
template <class Base>
std::size_t virtual_functions() {
  struct OneMore : Base {
    virtual void one_more() {}
  };
  const auto member = &OneMore::one_more;
  std::uintptr_t offset = 0;
  std::memcpy(&offset, &member, sizeof(offset));
  return offset / sizeof(void*) - 2;
}

/// Calls by the name of the callback.
using Heards = std::map<std::string_view, std::vector<Call>>;

/// The observer of each callback, in a list.
struct Observers {
  explicit Observers(std::unique_ptr<Heard> (*Callback::*add)(ObserverList& list)) {
    for (const Callback& one : kCallbacks) all.push_back((one.*add)(list));
  }

  /// What each has heard since the last time.
  Heards heard() {
    Heards result;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!all[i]->calls.empty()) result[kCallbacks[i].name] = std::exchange(all[i]->calls, {});
    }
    return result;
  }

  ObserverList list;
  std::vector<std::unique_ptr<Heard>> all;
};

TEST(ObserverList, IsTestedWithEveryCallbackThatThereIs) {
  EXPECT_EQ(kCallbacks.size() + std::tuple_size_v<decltype(kQuestions)>,
            virtual_functions<Observer>() + virtual_functions<AgentObserver>())
      << "a callback of Observer has no row in this test, and perhaps none in ObserverList";
}

TEST(ObserverList, PassesEachCallbackOnOnceToTheObserverThatOverridesIt) {
  Observers observers(&Callback::add);
  for (const Callback& one : kCallbacks) {
    const Call call = one.fire(observers.list);
    EXPECT_EQ(observers.heard(), (Heards{{one.name, {call}}})) << one.name;
  }
}

TEST(ObserverList, PassesEachCallbackOnOnceToAnObserverOfUnknownType) {
  Observers observers(&Callback::add_as_observer);
  for (const Callback& one : kCallbacks) {
    const Call call = one.fire(observers.list);
    EXPECT_EQ(observers.heard(), (Heards{{one.name, {call}}})) << one.name;
  }
}

/// Wants readings of one agent.
struct OfOneAgent final : Heard {
  bool observes_readings() const override { return wants_any; }
  bool observes(AgentId agent, const hal::Channel& /*channel*/) const override {
    return agent == AgentId{2};
  }
  void on_reading(Time at, AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override {
    heard(at, agent, channel, values);
  }
  bool wants_any = true;
};

TEST(ObserverList, PassesReadingsOnToThoseThatWantThem) {
  OfSinr deaf;
  OfOneAgent one;
  ObserverList list;
  list.add(deaf);
  EXPECT_FALSE(list.observes_readings());
  list.add(one);
  const hal::Channel channel;
  EXPECT_TRUE(list.observes_readings());
  EXPECT_TRUE(list.observes(AgentId{2}, channel));
  EXPECT_FALSE(list.observes(AgentId{3}, channel));
  list.on_reading({}, AgentId{2}, channel, {});
  list.on_reading({}, AgentId{3}, channel, {});
  EXPECT_EQ(one.calls.size(), 1u);
  one.wants_any = false;
  EXPECT_FALSE(list.observes_readings());
  EXPECT_FALSE(list.observes(AgentId{2}, channel));
  list.on_reading({}, AgentId{2}, channel, {});
  EXPECT_EQ(one.calls.size(), 1u);
}

}  // namespace
}  // namespace sim::agents
