#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/help/travel.h"
#include "controllers/labour/delivery.h"
#include "hal/api/controller.h"

namespace controllers {

/// One round of a robot as a gateway: it drives to one of the posts that it can localise, reports
/// from there to the sink, and stays for a while as a relay of the network.
///
///   IDLE --begin()--> PATROL --reached--> GATEWAY --stayed--> IDLE
///                        +--------- not reached in time --------^
///
/// It succeeds if the sink's receipt for the report is there when the robot leaves: from the post
/// there is a way through the network. Topic: "patrol".
class Patrol {
 public:
  static constexpr std::string_view kTask = "patrol";

  /// posts, timeout, reached, stay, and those of the report; their names begin with "patrol.".
  static std::vector<hal::ParameterSpec> parameters();
  /// Whether the robot chooses it at all, by its parameter `tasks`.
  static bool is_among_tasks(const hal::Parameters& parameters);
  /// What a robot that chooses it cannot do without or with: no sink, no post, one that is there
  /// twice.
  static std::vector<hal::ParameterMistake> mistakes(const hal::Parameters& parameters);
  /// @param timer  the one of the robot's timers that it uses.   @param travel  outlives this.
  Patrol(hal::Robot& robot, Travel& travel, const hal::Parameters& parameters, hal::TimerId timer);

  /// @pre no mistakes().  @throws std::invalid_argument  a post is no agent.
  void start(hal::AgentId sink);
  /// Whether there is a post to go to.
  bool can_begin() const { return !posts_in_sight().empty(); }
  void begin();   ///< @pre can_begin()
  void cancel();  ///< The robot turns to something else.
  void step();    ///< Once per control cycle.
  void timer() { report_.timer(); }
  void receive(const hal::Message& message) { report_.receive(message); }

  bool is_on() const { return is_on_; }
  /// Whether the last round that ended was a success.
  bool succeeded() const { return succeeded_; }

 private:
  std::vector<hal::AgentId> posts_in_sight() const;
  void go();
  void end(bool succeeded);

  hal::Robot& robot_;
  Travel& travel_;
  const std::vector<std::string> post_names_;
  const hal::Duration timeout_, stay_;
  const double reached_;  ///< m
  const Burst burst_;
  Delivery report_;

  std::vector<hal::AgentId> posts_;
  hal::AgentId sink_;
  std::optional<hal::AgentId> post_;  ///< Of the present round, or the last one.
  bool is_on_ = false;
  bool is_there_ = false;  ///< At the post.
  bool succeeded_ = false;
  hal::Time until_{};  ///< Of the drive, then of the stay.
};

}  // namespace controllers
