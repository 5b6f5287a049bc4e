#pragma once

#include <functional>
#include <memory>

#include "hal/api/controller.h"

namespace tests {

/// What the next controllers do in their callbacks; each test sets what it needs.
struct Script {
  std::function<void(hal::Robot&)> construct = [](hal::Robot&) {};
  std::function<void(hal::Robot&)> start = [](hal::Robot&) {};
  std::function<void(hal::Robot&)> step = [](hal::Robot&) {};
  std::function<void(hal::Robot&, const hal::Message&)> receive = [](hal::Robot&,
                                                                     const hal::Message&) {};
  std::function<void(hal::Robot&, hal::TimerId)> timer = [](hal::Robot&, hal::TimerId) {};
  std::function<void(hal::Robot&, hal::MessageId, hal::Fate)> notice =
      [](hal::Robot&, hal::MessageId, hal::Fate) {};
  std::function<void(hal::Robot&)> stop = [](hal::Robot&) {};
};

/// A robot's controller that follows a script, which it copies when it is made.
class Scripted : public hal::Controller {
 public:
  static Script& next() {
    static Script script;
    return script;
  }

  Scripted(hal::Robot& robot, const hal::Parameters&) : robot_(robot), script_(next()) {
    script_.construct(robot);
  }

  void start() override { script_.start(robot_); }
  void step() override { script_.step(robot_); }
  void receive(const hal::Message& message) override { script_.receive(robot_, message); }
  void timer(hal::TimerId id) override { script_.timer(robot_, id); }
  void notice(hal::MessageId id, hal::Fate fate) override { script_.notice(robot_, id, fate); }
  void stop() override { script_.stop(robot_); }

  static hal::ControllerKind kind() {
    return {.name = "scripted",
            .wants = {.channels = {"infrared", "localisation", "odometry", "battery"},
                      .watched = {"help"},
                      .neighbours = true},
            .make_for_robot = hal::make_for_robot<Scripted>};
  }

 private:
  hal::Robot& robot_;
  Script script_;
};

}  // namespace tests
