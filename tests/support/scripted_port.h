#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/node/exchange/ports.h"

namespace tests {

/// A controller process in a function: what it does about each event. It remembers all Steps.
class ScriptedPort final : public hal::node::exchange::ControllerPort {
 public:
  using Rule = std::function<std::vector<hal::node::exchange::Action>(
      const hal::node::exchange::Event& event)>;

  /// @param calls  gets a word for each begin() and finish(); null: none; outlives the port.
  explicit ScriptedPort(Rule rule = {}, std::string name = "script", std::string* calls = nullptr)
      : name_(std::move(name)), rule_(std::move(rule)), calls_(calls) {}

  const std::string& name() const override { return name_; }
  hal::Result<void> begin(const hal::node::exchange::Step& step) override {
    note("begin ");
    steps.push_back(step);
    reply_ = {};
    reply_.sequence = step.sequence;
    for (std::uint32_t i = 0; i < step.events.size(); ++i) {
      seen.push_back(step.events[i]);
      if (!rule_) continue;
      for (hal::node::exchange::Action& action : rule_(step.events[i])) {
        action.agent = step.events[i].agent;
        action.event = i;
        reply_.actions.push_back(std::move(action));
      }
    }
    return {};
  }
  hal::Result<hal::node::exchange::Reply> finish() override {
    note("finish ");
    if (auto alive = check_alive(); !alive) return tl::unexpected<hal::Error>(alive.error());
    return std::move(reply_);
  }
  hal::Result<std::optional<hal::node::exchange::Reply>> try_finish() override {
    if (auto alive = check_alive(); !alive) return tl::unexpected<hal::Error>(alive.error());
    if (answers == 0) return std::nullopt;
    if (answers) --*answers;
    return std::move(reply_);
  }
  bool shares_time() const override { return shares; }
  hal::Result<void> check_alive() override {
    if (dead) return hal::fail(hal::Errc::kNotConnected, "killed by signal 9");
    return {};
  }

  std::vector<hal::node::exchange::Event> of(hal::node::exchange::Cause cause) const {
    std::vector<hal::node::exchange::Event> found;
    for (const auto& event : seen) {
      if (event.cause() == cause) found.push_back(event);
    }
    return found;
  }

  std::vector<hal::node::exchange::Step> steps;
  std::vector<hal::node::exchange::Event> seen;  ///< Of all Steps.
  /// That it gives before it is too busy for more, where nobody waits for it; none: any number.
  std::optional<int> answers;
  bool dead = false;
  bool shares = false;  ///< The simulated time; to be set before it is connected.

 private:
  void note(const char* call) {
    if (calls_ != nullptr) *calls_ += call + name_ + "; ";
  }

  std::string name_;
  Rule rule_;
  std::string* calls_;
  hal::node::exchange::Reply reply_;
};

}  // namespace tests
