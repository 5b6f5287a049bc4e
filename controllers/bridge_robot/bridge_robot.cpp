#include "controllers/bridge_robot/bridge_robot.h"

#include <algorithm>
#include <array>

#include "hal/types/math.h"

namespace controllers {
namespace {

/// In the order of State.
constexpr std::array<std::string_view, 5> kStateNames{"IDLE", "LISTEN", "BID", "GO_TO_GAP",
                                                      "BRIDGE"};

double length(hal::Vec2 way) { return hal::math::hypot(way.x, way.y); }

}  // namespace

BridgeRobot::BridgeRobot(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      parameters_(parameters),
      weights_{.need = parameters["need_weight"],
               .energy = parameters["energy_weight"],
               .distance = parameters["distance_weight"],
               .drive_cost = parameters["drive_cost"],
               .reserve = parameters["reserve"]} {}

void BridgeRobot::start() { enter(State::kIdle); }

void BridgeRobot::stop() { (void)robot_.set_body_velocity({}); }

void BridgeRobot::step() {
  forget_old();
  const bool is_over = robot_.now() >= deadline_;
  switch (state_) {
    case State::kIdle:
      if (calls_.empty()) return;
      deadline_ = robot_.now() + seconds("listen");
      return enter(State::kListen);
    case State::kListen:
      return is_over ? choose() : void();
    case State::kBid:
      return is_over ? settle() : void();
    case State::kGoToGap:
      return go();
    case State::kBridge:
      return keep_claiming();
  }
}

void BridgeRobot::receive(const hal::Message& message) {
  const auto heard = message.topic == kGapTopic ? decode_gap(message.payload) : std::nullopt;
  if (!heard) return;
  if (heard->word == GapWord::kCutOff) calls_[message.source] = {robot_.now(), heard->value};
  if (heard->word == GapWord::kBid) bids_[message.source] = *heard;
  if (heard->word != GapWord::kClaim) return;
  claimed_[heard->island] = robot_.now();
  const bool is_mine = state_ == State::kGoToGap && heard->island == gap_.island;
  // Both robots won because a bid was lost: the one with the lower address continues.
  if (!is_mine || robot_.id() < message.source) return;
  (void)robot_.set_body_velocity({});
  enter(State::kIdle);
}

void BridgeRobot::forget_old() {
  const hal::Time now = robot_.now();
  std::erase_if(calls_, [&](const auto& call) { return now - call.second.at > seconds("forget"); });
  std::erase_if(claimed_,
                [&](const auto& claim) { return now - claim.second > seconds("forget"); });
}

std::vector<Seen> BridgeRobot::seen() const {
  std::vector<Seen> all;
  const auto localised = robot_.reading("localisation");
  if (!localised) return all;
  for (std::size_t i = 0; i + 2 < localised->size(); i += 3) {
    const auto address = static_cast<std::uint16_t>((*localised)[i]);
    all.push_back({hal::AgentId{address}, {(*localised)[i + 1], (*localised)[i + 2]}});
  }
  return all;
}

/// Bids for the gap with the greatest worth that no other robot claims.
void BridgeRobot::choose() {
  std::map<hal::AgentId, double> callers;
  for (const auto& [mote, call] : calls_) callers[mote] = call.need;
  const double energy = robot_.battery_energy().value_or(parameters_["energy_without_gauge"]);
  bid_ = 0;
  for (const Gap& gap : find_gaps(seen(), callers, parameters_["reach"])) {
    const double value = worth(gap, length(gap.place), energy, weights_);
    if (claimed_.contains(gap.island) || value <= bid_) continue;
    gap_ = gap;
    bid_ = value;
  }
  if (bid_ <= 0) return enter(State::kIdle);
  robot_.record("bid", bid_);
  robot_.record("distance", length(gap_.place));
  deadline_ = robot_.now() + seconds("bid_time");
  enter(State::kBid);
  say(GapWord::kBid, bid_);
}

/// Starts if this robot's bid for the gap is the highest; ties go to the lowest address.
void BridgeRobot::settle() {
  const bool is_best = std::ranges::none_of(bids_, [this](const auto& entry) {
    const auto& [other, bid] = entry;
    if (bid.island != gap_.island) return false;
    return bid.value > bid_ || (bid.value == bid_ && other < robot_.id());
  });
  bids_.clear();
  if (!is_best || claimed_.contains(gap_.island)) {
    claimed_[gap_.island] = robot_.now();
    return enter(State::kIdle);
  }
  deadline_ = robot_.now() + seconds("give_up_after");
  claim_at_ = robot_.now();
  enter(State::kGoToGap);
}

void BridgeRobot::go() {
  keep_claiming();
  const auto near = robot_.relative_position(gap_.near);
  const auto far = robot_.relative_position(gap_.far);
  if (robot_.now() >= deadline_) {
    (void)robot_.set_body_velocity({});
    return enter(State::kIdle);
  }
  // Not localised: wait.
  if (!near || !far) return stop();
  const hal::Vec2 place = 0.5 * (*near + *far);
  const double distance = length(place);
  if (distance >= parameters_["near"]) return drive(place, distance);
  stop();
  enter(State::kBridge);
}

void BridgeRobot::keep_claiming() {
  if (robot_.now() < claim_at_) return;
  claim_at_ = robot_.now() + seconds("claim_every");
  say(GapWord::kClaim);
}

/// Drives straight, or sideways past obstacles that the infrared sensors see ahead.
void BridgeRobot::drive(hal::Vec2 to, double distance) {
  constexpr double kTooNear = 0.5;  // m
  const auto infrared = robot_.infrared();
  if (!infrared) return stop();  // no infrared reading yet
  hal::Vec2 way = 1 / distance * to;
  for (const auto& [heading, range] : *infrared) {
    const hal::Vec2 look{hal::math::cos(heading), hal::math::sin(heading)};
    if (range < kTooNear && hal::dot(look, way) > 0.5) way = {-look.y, look.x};
  }
  const double speed = parameters_["speed"];
  (void)robot_.set_body_velocity({.vx = speed * way.x, .vy = speed * way.y});
}

void BridgeRobot::say(GapWord word, double value) {
  (void)robot_.send(hal::kEveryone, kGapTopic,
                    encode({.word = word, .island = gap_.island, .value = value}));
}

void BridgeRobot::enter(State state) {
  state_ = state;
  robot_.state(kStateNames[static_cast<std::size_t>(state)]);
}

}  // namespace controllers

BARAKA_CONTROLLER {
  constexpr double kHour = 3600;  // s
  return {.name = "bridge_robot",
          .wants = {.channels = {"infrared", "localisation", "battery"}},
          .parameters =
              {{"speed", "m/s", 0.8, 0.01, 5, "Speed of travel."},
               {"reach", "m", 50, 0.1, 1e5, "How far a radio reaches, as far as the robot knows."},
               {"near", "m", 1.5, 0.1, 1000, "It is at its place below this distance from it."},
               {"need_weight", "1", 1, 0, 20, "Exponent of the need of those that are cut off."},
               {"energy_weight", "1", 1, 0, 20, "Exponent of the energy that is left on arrival."},
               {"distance_weight", "1", 1, 0, 20, "Exponent of 1 / (1 m + distance)."},
               {"drive_cost", "J/m", 144, 0, 1e6, "Energy that a metre costs."},
               {"reserve", "J", 7200, 0, 1e12, "Energy that must be left on arrival."},
               {"energy_without_gauge", "J", 144e3, 0, 1e12,
                "What it takes for its energy if no gauge tells it."},
               {"listen", "s", 6, 0, kHour, "From the first call to its choice."},
               {"bid_time", "s", 2, 0.1, kHour, "From its bid to its decision."},
               {"claim_every", "s", 5, 0.5, kHour, "Time between two claims."},
               {"forget", "s", 20, 1, kHour, "Calls and claims that are older do not count."},
               {"give_up_after", "s", 300, 1, kHour, "Time for the way."}},
          .states = {controllers::kStateNames.begin(), controllers::kStateNames.end()},
          .make_for_robot = hal::make_for_robot<controllers::BridgeRobot>};
}
