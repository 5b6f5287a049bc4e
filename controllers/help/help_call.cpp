#include "controllers/help/help_call.h"

namespace controllers {

std::vector<hal::ParameterSpec> HelpCall::parameters(const std::string& prefix) {
  constexpr double kHour = 3600;  // s
  return {{prefix + "repeat_after", "s", 30, 1, kHour, "Time before a call is repeated."},
          {prefix + "repeat_jitter", "1", 0.1, 0, 1,
           "Largest share of repeat_after by which a repeat comes early, at random."},
          {prefix + "max_repeats", "1", 3, 0, 1000, "Calls after the first one."},
          {prefix + "max_hop", "s", 300, 1, kHour,
           "How long it waits for a robot that does not say how long it needs."}};
}

HelpCall::HelpCall(hal::Mote& mote, const hal::Parameters& parameters, const std::string& prefix)
    : mote_(mote),
      repeat_after_(hal::from_seconds(parameters[prefix + "repeat_after"])),
      repeat_jitter_(parameters[prefix + "repeat_jitter"]),
      max_repeats_(static_cast<int>(parameters[prefix + "max_repeats"])),
      max_hop_(hal::from_seconds(parameters[prefix + "max_hop"])) {}

void HelpCall::begin() {
  owner_.reset();
  repeats_ = 0;
  broadcast();
  enter(State::kRequest);
}

void HelpCall::step() {
  const hal::Time now = mote_.now();
  if (state_ == State::kRequest && now >= deadline_) repeat_or_give_up();
  if (state_ == State::kWait && now >= deadline_) begin();
}

void HelpCall::receive(const hal::Message& message) {
  const auto heard = message.topic == kHelpTopic ? decode(message.payload) : std::nullopt;
  if (!heard) return;
  if (heard->word == HelpWord::kAsk) on_asked(message.source, heard->max_hop);
  if (message.source != owner_) return;
  if (heard->word == HelpWord::kArrived) {
    owner_.reset();
    enter(State::kFulfilled);
  }
  if (heard->word == HelpWord::kGiveUp) begin();
}

void HelpCall::on_asked(hal::AgentId robot, hal::Duration max_hop) {
  if (state_ != State::kRequest && robot != owner_) return say(robot, HelpWord::kRefuse);
  owner_ = robot;
  deadline_ = mote_.now() + (max_hop > hal::Duration{} ? max_hop : max_hop_);
  say(robot, HelpWord::kGrant);
  if (state_ != State::kWait) enter(State::kWait);
}

void HelpCall::broadcast() {
  const double wait = 1 - repeat_jitter_ * mote_.random().uniform();
  deadline_ = mote_.now() + hal::from_seconds(wait * hal::to_seconds(repeat_after_));
  say(hal::kEveryone, HelpWord::kHelp);
}

void HelpCall::repeat_or_give_up() {
  if (repeats_ == max_repeats_) return enter(State::kGaveUp);
  ++repeats_;
  broadcast();
}

void HelpCall::say(hal::AgentId to, HelpWord word) {
  // The HAL logs what it refuses; the robot repeats its request if this message is lost.
  (void)mote_.send(to, kHelpTopic, encode({.word = word}));
}

void HelpCall::enter(State state) {
  state_ = state;
  mote_.state(kStateNames[static_cast<std::size_t>(state)]);
}

}  // namespace controllers
