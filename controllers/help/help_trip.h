#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/help/travel.h"
#include "controllers/help_message.h"
#include "hal/api/controller.h"
#include "hal/types/path_metric.h"

namespace controllers {

/// A robot's trip to a mote that called for help, along the hops of the network's route.
///
///   IDLE --begin()--> SELECT_DESTINATION --asks--> REQUEST_ASSIGNMENT
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
/// Time-outs are checked once per control cycle. (Labella, Dietrich, Dressler, "Hybrid simulation
/// of
/// Sensor and Actor Networks with BARAKA", 2009, section 6.2.)
class HelpTrip {
 public:
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
  /// The names under which the robot records its states, in the order of State.
  static constexpr std::array<std::string_view, 9> kStateNames{"IDLE",
                                                               "SELECT_DESTINATION",
                                                               "REQUEST_ASSIGNMENT",
                                                               "FIND_NEXT_HOP",
                                                               "REQUEST_NEXT_HOP",
                                                               "GO_TO_NEXT_HOP",
                                                               "GO_TO_DESTINATION",
                                                               "GIVE_UP",
                                                               "ARRIVED"};

  /// Parameters of the trip. @param prefix  of their names, e.g. "answer."; may be empty.
  static std::vector<hal::ParameterSpec> parameters(const std::string& prefix);
  /// @param parameters  those above and those of Travel.   @param travel  outlives this.
  HelpTrip(hal::Robot& robot, Travel& travel, const hal::Parameters& parameters,
           const std::string& prefix);

  void idle() { enter(State::kIdle); }
  void begin(hal::AgentId mote);  ///< @pre !is_on()
  void step();                    ///< Call once per control cycle.
  void receive(hal::AgentId from, HelpWord word);

  bool is_on() const { return state_ != State::kIdle; }
  bool is_to(hal::AgentId mote) const { return is_on() && mote == destination_; }
  /// Whether the last trip that ended reached its mote.
  bool has_arrived() const { return has_arrived_; }
  /// Whether it ended because another robot has the task, or the task no longer exists.
  bool was_refused() const { return was_refused_; }
  /// r(.) of equation 1 (hal/types/path_metric.h), used to choose hops.
  const hal::PathMetric& metric() const { return metric_; }

 private:
  void enter(State state);
  bool is_under_way() const;
  void request(State state);
  void wait_for_answer();
  void on_answer(bool granted);
  void find_next_hop();
  std::vector<hal::Route> routes_ahead() const;
  void go();
  void keep_in_touch(double distance);
  void give_up();
  void arrive();
  void say(HelpWord word);

  hal::Robot& robot_;
  Travel& travel_;
  const hal::Duration keep_alive_;
  const hal::Duration hop_timeout_;
  const hal::Duration reply_timeout_;
  const int max_repeats_;
  const double near_, reached_;  ///< m
  const hal::PathMetric metric_;
  const double beta_;

  State state_ = State::kIdle;
  hal::AgentId destination_;          ///< In every state except IDLE.
  hal::AgentId next_hop_;             ///< In both GO_TO states.
  std::optional<hal::AgentId> left_;  ///< The hop reached last, at which the robot stands.
  int repeats_ = 0;
  hal::Time deadline_{};       ///< End of the states that wait or drive.
  hal::Time keep_alive_at_{};  ///< In the states that drive.
  bool asked_near_ = false;    ///< The request on approaching the next hop was sent.
  bool has_arrived_ = false, was_refused_ = false;
};

}  // namespace controllers
