#include "controllers/help_mote/help_mote.h"

#include <array>
#include <cmath>
#include <limits>

namespace controllers {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kHour = 3600;  // s

/// By State.
constexpr std::array<std::string_view, 5> kStateNames{"IDLE", "REQUEST", "WAIT", "FULFILLED",
                                                      "GAVE_UP"};

std::optional<hal::Time> time_or_never(double seconds) {
  if (!std::isfinite(seconds)) return std::nullopt;
  return hal::Time{hal::from_seconds(seconds)};
}

}  // namespace

HelpMote::HelpMote(hal::Mote& mote, const hal::Parameters& parameters)
    : mote_(mote),
      help_at_(time_or_never(parameters["help_at"])),
      repeat_after_(hal::from_seconds(parameters["repeat_after"])),
      max_repeats_(static_cast<int>(parameters["max_repeats"])),
      max_hop_(hal::from_seconds(parameters["max_hop"])) {}

void HelpMote::start() { enter(State::kIdle); }

void HelpMote::step() {
  const hal::Time now = mote_.now();
  if (state_ == State::kIdle && help_at_ && now >= *help_at_) call_for_help();
  if (state_ == State::kRequest && now >= deadline_) repeat_or_give_up();
  if (state_ == State::kWait && now >= deadline_) call_for_help();
}

void HelpMote::receive(const hal::Message& message) {
  const auto heard = message.topic == kHelpTopic ? decode(message.payload) : std::nullopt;
  if (!heard) return;
  if (heard->word == HelpWord::kAsk) on_asked(message.source, heard->max_hop);
  if (message.source != owner_) return;
  if (heard->word == HelpWord::kArrived) {
    owner_.reset();
    enter(State::kFulfilled);
  }
  if (heard->word == HelpWord::kGiveUp) call_for_help();
}

void HelpMote::on_asked(hal::AgentId robot, hal::Duration max_hop) {
  if (state_ != State::kRequest && robot != owner_) return say(robot, HelpWord::kRefuse);
  owner_ = robot;
  deadline_ = mote_.now() + (max_hop > hal::Duration{} ? max_hop : max_hop_);
  say(robot, HelpWord::kGrant);
  if (state_ != State::kWait) enter(State::kWait);
}

void HelpMote::call_for_help() {
  owner_.reset();
  repeats_ = 0;
  deadline_ = mote_.now() + repeat_after_;
  say(hal::kEveryone, HelpWord::kHelp);
  enter(State::kRequest);
}

void HelpMote::repeat_or_give_up() {
  if (repeats_ == max_repeats_) return enter(State::kGaveUp);
  ++repeats_;
  deadline_ = mote_.now() + repeat_after_;
  say(hal::kEveryone, HelpWord::kHelp);
}

void HelpMote::say(hal::AgentId to, HelpWord word) {
  // What the HAL refuses it also logs; what gets lost on its way is repeated by the robot.
  (void)mote_.send(to, kHelpTopic, encode({.word = word}));
}

void HelpMote::enter(State state) {
  state_ = state;
  mote_.state(kStateNames[static_cast<std::size_t>(state)]);
}

}  // namespace controllers

BARAKA_CONTROLLER {
  using controllers::kHour, controllers::kNever;
  return {.name = "help_mote",
          .parameters = {{"help_at", "s", kNever, 0, kNever, "When it calls for help."},
                         {"repeat_after", "s", 30, 1, kHour, "Time between two calls."},
                         {"max_repeats", "1", 3, 0, 1000, "Calls after the first one."},
                         {"max_hop", "s", 300, 1, kHour,
                          "How long it waits for a robot that does not say how long it needs."}},
          .states = {controllers::kStateNames.begin(), controllers::kStateNames.end()},
          .make_for_mote = hal::make_for_mote<controllers::HelpMote>};
}
