#pragma once

#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "controllers/help_message.h"
#include "controllers/help_robot/avoidance.h"
#include "hal/api/controller.h"
#include "hal/types/path_metric.h"

namespace controllers {

/// A robot that drives to motes that call for help, from one hop of the network's route to the
/// next.
///
///   IDLE --somebody called--> SELECT_DESTINATION --asks--> REQUEST_ASSIGNMENT
///                                                               | granted
///                 route appears                                 v
///   REQUEST_NEXT_HOP ------------------------------------> FIND_NEXT_HOP <-----------------+
///          ^                                                |   |  | hop is the mote       |
///          +--------------- no route: asks -----------------+   |  +-> GO_TO_DESTINATION   |
///                                                   hop is not  |             | near       |
///                                                               v             v            |
///                                                    GO_TO_NEXT_HOP        ARRIVED         |
///                                                               | reached     |            |
///                                                               +-------------|------------+
///                                                                             v
///   refused: IDLE. No answer to the last repeat, or hop not reached in time: GIVE_UP, then IDLE.
///
/// Times are looked at once per control cycle. (Labella, Dietrich, Dressler, "Hybrid simulation of
/// Sensor and Actor Networks with BARAKA", 2009, section 6.2.)
class HelpRobot : public hal::Controller {
 public:
  HelpRobot(hal::Robot& robot, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;
  void stop() override;

 private:
  enum class State {
    kIdle,
    kSelectDestination,
    kRequestAssignment,
    kFindNextHop,
    kRequestNextHop,
    kGoToNextHop,
    kGoToDestination,
    kGiveUp,
    kArrived,
  };

  void enter(State state);
  bool is_under_way() const;
  void select_destination();
  void request(State state);
  void wait_for_answer();
  void on_answer(bool granted);
  void find_next_hop();
  std::vector<hal::Route> routes_ahead() const;
  hal::AgentId draw_next_hop(const std::vector<hal::Route>& routes);
  void go();
  void keep_in_touch(double distance);
  void drive(hal::Vec2 to, double distance);
  void halt();
  void give_up();
  void arrive();
  void say(HelpWord word);

  hal::Robot& robot_;
  const hal::Parameters parameters_;
  const hal::PathMetric metric_;  ///< By which it prefers hops.
  const hal::Duration keep_alive_;
  const hal::Duration hop_timeout_;
  const hal::Duration reply_timeout_;

  State state_ = State::kIdle;
  std::set<hal::AgentId> calls_;      ///< Motes that asked for help, without the destination.
  hal::AgentId destination_;          ///< Of every state but IDLE.
  hal::AgentId next_hop_;             ///< Of both GO_TO states.
  std::optional<hal::AgentId> left_;  ///< The hop reached last: the robot stands at it.
  int repeats_ = 0;
  hal::Time deadline_{};       ///< Of the states that wait or go.
  hal::Time keep_alive_at_{};  ///< Of the states that go.
  bool asked_near_ = false;    ///< The question of being near the next hop was sent.
  Avoidance avoidance_;
};

}  // namespace controllers
