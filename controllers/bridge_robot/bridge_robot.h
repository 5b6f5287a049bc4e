#pragma once

#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "controllers/bridge_robot/gaps.h"
#include "controllers/gap_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// A robot that bridges gaps in the network: it listens for motes that are cut off, weighs
/// distance, energy and need of each gap, bids against other robots, drives to a gap, and stays
/// there.
///
///   IDLE --a mote calls--> LISTEN --has heard the others--> BID --no higher bid--> GO_TO_GAP
///    ^                      | no gap worth a bid             | higher bid           |  | near
///    +----------------------+--------------------------------+                      |  v
///    +---------- not reached in time, or claimed by another robot ------------------+ BRIDGE
///
/// A gap claimed by another robot is left to it as long as it repeats the claim. Time-outs are
/// checked once per control cycle.
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

  /// A call of a mote, and when it was heard.
  struct Heard {
    hal::Time at{};
    double need = 0;
  };

  hal::Robot& robot_;
  const hal::Parameters parameters_;
  const Weights weights_;

  State state_ = State::kIdle;
  hal::Time deadline_{};                 ///< End of LISTEN, BID or GO_TO_GAP.
  hal::Time claim_at_{};                 ///< Time of the next claim.
  std::map<hal::AgentId, Heard> calls_;  ///< By calling mote.
  /// Islands that other robots claim, and when they did so.
  std::map<hal::AgentId, hal::Time> claimed_;
  std::map<hal::AgentId, GapMessage> bids_;  ///< Bids of other robots in this round, by robot.
  Gap gap_;                                  ///< Gap of BID, GO_TO_GAP and BRIDGE.
  double bid_ = 0;
};

}  // namespace controllers
