#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "controllers/bridge_robot/gaps.h"
#include "controllers/gap_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A robot that bridges gaps of the network: it hears motes that are cut off, weighs distance,
/// energy and need of what it could bridge against what other robots bid, drives there, and stays.
///
///   IDLE --a mote calls--> LISTEN --has heard the others--> BID --nobody bids more--> GO_TO_GAP
///    ^                      | nothing to be won              | somebody does            |  | near
///    +----------------------+--------------------------------+                          |  v
///    +------------------ not reached in time, or somebody else claims it ---------------+ BRIDGE
///
/// What another robot claims is left to it as long as it says so. Times are looked at once per
/// control cycle.
class BridgeRobot : public hal::Controller {
 public:
  BridgeRobot(hal::Robot& robot, const hal::Parameters& parameters);

  void start() override;
  void step() override;
  void receive(const hal::Message& message) override;
  void stop() override;

 private:
  enum class State { kIdle, kListen, kBid, kGoToGap, kBridge };

  void enter(State state);
  void forget_old();
  std::vector<Seen> seen() const;
  void choose();
  void settle();
  void go();
  void keep_claiming();
  void drive(hal::Vec2 to, double distance);
  void say(GapWord word, double value = 0);
  hal::Duration seconds(std::string_view parameter) const {
    return hal::from_seconds(parameters_[parameter]);
  }

  /// What somebody said, and when.
  struct Heard {
    hal::Time at{};
    double need = 0;
  };

  hal::Robot& robot_;
  const hal::Parameters parameters_;
  const Weights weights_;

  State state_ = State::kIdle;
  hal::Time deadline_{};                       ///< Of LISTEN, BID and GO_TO_GAP.
  hal::Time claim_at_{};                       ///< Of the next claim.
  std::map<hal::AgentId, Heard> calls_;        ///< By mote.
  std::map<hal::AgentId, hal::Time> claimed_;  ///< Islands that others see to: when they said so.
  std::map<hal::AgentId, GapMessage> bids_;    ///< Of others in this round, by robot.
  Gap gap_;                                    ///< Of BID, GO_TO_GAP and BRIDGE.
  double bid_ = 0;
};

}  // namespace controllers
