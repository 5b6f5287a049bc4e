#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "controllers/help/travel.h"
#include "controllers/labour/delivery.h"
#include "hal/api/controller.h"

namespace controllers {

/// One round of a robot as a gateway: it drives to one of the posts that it can localise, sends a
/// report to the sink from there, and stays for a while as a relay of the network.
///
///   IDLE --begin()--> PATROL --reached--> GATEWAY --stayed--> IDLE
///                        +--------- not reached in time --------^
///
/// It succeeds if the sink's receipt for the report has arrived when the robot leaves: the post is
/// connected to the sink. Topic: "patrol".
class Patrol {
 public:
  static constexpr std::string_view kTask = "patrol";

  /// Parameters posts, timeout, reached, stay, and those of the report; their names begin with
  /// "patrol.".
  static std::vector<hal::ParameterSpec> parameters();
  /// Whether patrol is among the robot's tasks, by its parameter `tasks`.
  static bool is_among_tasks(const hal::Parameters& parameters);
  /// Mistakes in the parameters of a robot with this task: no sink, no post, a post listed twice.
  static std::vector<hal::ParameterMistake> mistakes(const hal::Parameters& parameters);
  /// @param timer  the id of the robot's timer that it uses.   @param travel  outlives this.
  Patrol(hal::Robot& robot, Travel& travel, const hal::Parameters& parameters, hal::TimerId timer);

  /// @pre no mistakes().  @throws std::invalid_argument  a post is not an agent.
  void start(hal::AgentId sink);
  /// Whether a post is localised.
  bool can_begin() const { return !posts_in_sight().empty(); }
  void begin();   ///< @pre can_begin()
  void cancel();  ///< Ends the round without a result.
  void step();    ///< Call once per control cycle.
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
  std::optional<hal::AgentId> post_;  ///< Post of the current round, or of the last one.
  bool is_on_ = false;
  bool is_there_ = false;  ///< At the post.
  bool succeeded_ = false;
  hal::Time until_{};  ///< End of the drive, then of the stay.
};

}  // namespace controllers
