#include "controllers/help_robot/help_robot.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "controllers/help_robot/way_past.h"
#include "hal/types/math.h"

namespace controllers {
namespace {

/// By State.
constexpr std::array<std::string_view, 9> kStateNames{"IDLE",
                                                      "SELECT_DESTINATION",
                                                      "REQUEST_ASSIGNMENT",
                                                      "FIND_NEXT_HOP",
                                                      "REQUEST_NEXT_HOP",
                                                      "GO_TO_NEXT_HOP",
                                                      "GO_TO_DESTINATION",
                                                      "GIVE_UP",
                                                      "ARRIVED"};
/// Values of the parameter `metric`.
std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const hal::PathStatistic statistic : hal::kPathStatistics) {
    names.emplace_back(name(statistic));
  }
  return names;
}

hal::PathMetric metric_of(const hal::Parameters& parameters) {
  const auto statistic = hal::path_statistic(parameters.text("metric"));
  return hal::path_metric(statistic.value_or(hal::PathStatistic::kHops),
                          parameters["direct_weight"]);
}

constexpr double kRoomToPass = 0.15;  // m between the body's rim and the centre of a mote

}  // namespace

HelpRobot::HelpRobot(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      parameters_(parameters),
      metric_(metric_of(parameters)),
      keep_alive_(hal::from_seconds(parameters["keep_alive"])),
      hop_timeout_(hal::from_seconds(parameters["hop_timeout"])),
      reply_timeout_(hal::from_seconds(parameters["reply_timeout"])),
      avoidance_({.speed = parameters["speed"],
                  .body_radius = parameters["body_radius"],
                  .gap = parameters["wall_gap"],
                  .clear_for = hal::from_seconds(parameters["clear_for"])}) {}

void HelpRobot::start() { enter(State::kIdle); }

void HelpRobot::stop() { halt(); }

void HelpRobot::step() {
  if (state_ == State::kIdle && !calls_.empty()) return select_destination();
  if (state_ == State::kRequestAssignment || state_ == State::kRequestNextHop) {
    return wait_for_answer();
  }
  if (is_under_way()) go();
}

void HelpRobot::receive(const hal::Message& message) {
  const auto heard = message.topic == kHelpTopic ? decode(message.payload) : std::nullopt;
  if (!heard) return;
  const bool is_destination = state_ != State::kIdle && message.source == destination_;
  if (heard->word == HelpWord::kHelp && !is_destination) calls_.insert(message.source);
  if (heard->word == HelpWord::kGrant && is_destination) on_answer(true);
  if (heard->word == HelpWord::kRefuse && is_destination) on_answer(false);
}

bool HelpRobot::is_under_way() const {
  return state_ == State::kGoToNextHop || state_ == State::kGoToDestination;
}

void HelpRobot::select_destination() {
  enter(State::kSelectDestination);
  const auto choice = robot_.random().below(static_cast<std::uint32_t>(calls_.size()));
  const auto chosen = std::next(calls_.begin(), choice);
  destination_ = *chosen;
  calls_.erase(chosen);
  left_.reset();
  request(State::kRequestAssignment);
}

/// Asks the destination and waits in `state` for what comes of it: its answer, and the routes that
/// the question finds on its way.
void HelpRobot::request(State state) {
  halt();
  repeats_ = 0;
  deadline_ = robot_.now() + reply_timeout_;
  say(HelpWord::kAsk);
  enter(state);
}

void HelpRobot::wait_for_answer() {
  if (state_ == State::kRequestNextHop && !routes_ahead().empty()) return find_next_hop();
  if (robot_.now() < deadline_) return;
  if (repeats_ == static_cast<int>(parameters_["max_repeats"])) return give_up();
  ++repeats_;
  deadline_ = robot_.now() + reply_timeout_;
  // No answer: the way there or the way back is not what the network believes. A new search teaches
  // the nodes on it both.
  (void)robot_.network().invalidate(kHelpTopic, destination_);
  say(HelpWord::kAsk);
}

void HelpRobot::on_answer(bool granted) {
  if (!granted) {
    halt();
    return enter(State::kIdle);
  }
  if (state_ == State::kRequestAssignment ||
      (state_ == State::kRequestNextHop && !routes_ahead().empty())) {
    find_next_hop();
  }
}

/// Routes to the destination that do not lead back to the hop the robot stands at.
std::vector<hal::Route> HelpRobot::routes_ahead() const {
  auto routes = std::as_const(robot_).network().routes(kHelpTopic, destination_);
  std::erase_if(routes, [this](const hal::Route& route) {
    return route.next_hop == left_ && route.next_hop != destination_;
  });
  return routes;
}

void HelpRobot::find_next_hop() {
  enter(State::kFindNextHop);
  const auto routes = routes_ahead();
  if (routes.empty()) {
    // What is left leads back here, if anything: it must not spare the network a new search.
    (void)robot_.network().invalidate(kHelpTopic, destination_);
    return request(State::kRequestNextHop);
  }
  next_hop_ = draw_next_hop(routes);
  deadline_ = robot_.now() + hop_timeout_;
  keep_alive_at_ = robot_.now() + keep_alive_;
  asked_near_ = false;
  avoidance_.aim_anew();
  enter(next_hop_ == destination_ ? State::kGoToDestination : State::kGoToNextHop);
}

/// Draws a hop as routing does for packets, by a metric of the robot's own.
hal::AgentId HelpRobot::draw_next_hop(const std::vector<hal::Route>& routes) {
  return routes[hal::draw_route(routes, metric_, parameters_["beta"], robot_.random())].next_hop;
}

void HelpRobot::go() {
  if (robot_.now() >= deadline_) return give_up();
  const auto to = robot_.relative_position(next_hop_);
  // Not localised: wait, until it is or the time is up.
  if (!to) return halt();
  const double distance = hal::math::hypot(to->x, to->y);
  if (state_ == State::kGoToDestination && distance < parameters_["near"]) return arrive();
  if (state_ == State::kGoToNextHop && distance < parameters_["reached"]) {
    left_ = next_hop_;
    return find_next_hop();
  }
  keep_in_touch(distance);
  drive(*to, distance);
}

/// Tells the mote that the robot is still coming. On the way to a hop this also renews the route,
/// so that the network's view of the robot's place follows the robot.
void HelpRobot::keep_in_touch(double distance) {
  const bool to_hop = state_ == State::kGoToNextHop;
  const bool comes_near = to_hop && !asked_near_ && distance < parameters_["near"];
  if (!comes_near && robot_.now() < keep_alive_at_) return;
  if (comes_near) asked_near_ = true;
  keep_alive_at_ = robot_.now() + keep_alive_;
  if (to_hop) (void)robot_.network().invalidate(kHelpTopic, destination_);
  say(HelpWord::kAsk);
}

void HelpRobot::drive(hal::Vec2 to, double distance) {
  const auto infrared = robot_.infrared();
  // Blind, before the sensors' first sample: stay.
  const auto localised = robot_.reading("localisation");
  if (!infrared || !localised) return halt();
  const hal::Vec2 way =
      way_past(1 / distance * to, *localised, parameters_["body_radius"] + kRoomToPass);
  (void)robot_.set_body_velocity(avoidance_.steer(way, *infrared, robot_.now()));
}

void HelpRobot::halt() { (void)robot_.set_body_velocity({}); }

void HelpRobot::give_up() {
  halt();
  enter(State::kGiveUp);
  say(HelpWord::kGiveUp);
  enter(State::kIdle);
}

void HelpRobot::arrive() {
  halt();
  say(HelpWord::kArrived);
  enter(State::kArrived);
  enter(State::kIdle);
}

void HelpRobot::say(HelpWord word) {
  // What the HAL refuses it also logs; what gets lost on its way is repeated.
  (void)robot_.send(destination_, kHelpTopic, encode({.word = word, .max_hop = hop_timeout_}));
}

void HelpRobot::enter(State state) {
  state_ = state;
  robot_.state(kStateNames[static_cast<std::size_t>(state)]);
}

}  // namespace controllers

BARAKA_CONTROLLER {
  constexpr double kHour = 3600;  // s
  return {.name = "help_robot",
          .wants = {.channels = {"infrared", "localisation"},
                    .watched = {std::string(controllers::kHelpTopic)}},
          .parameters =
              {{"speed", "m/s", 0.94, 0.01, 5, "Speed of travel."},
               {"keep_alive", "s", 15, 1, kHour, "Time between two messages to the mote."},
               {"hop_timeout", "s", 300, 1, kHour, "Time for one hop before it gives up."},
               {"reply_timeout", "s", 30, 1, kHour, "Time for an answer before it asks again."},
               {"max_repeats", "1", 3, 0, 1000, "Questions after the first one."},
               {"near", "m", 10, 0.5, 1000, "Asks for the next hop, or has arrived, below this."},
               {"reached", "m", 4, 0.5, 1000, "A hop has been reached below this."},
               {.name = "metric",
                .default_value = "hops",
                .meaning = "What makes a path good: the robot prefers hops on such ones.",
                .choices = controllers::metric_names()},
               {"direct_weight", "1", 1e6, 0, 1e12,
                "Weight of a hop that is the mote itself; 0: that of its path, as of others."},
               {"beta", "1", 2, 1, 20, "Exponent of the weights."},
               {"body_radius", "m", 0.185, 0.01, 2, "From the middle to the infrared sensors."},
               {"wall_gap", "m", 0.265, 0.1, 2, "Between the body and a wall it follows."},
               {"clear_for", "s", 1.2, 0, 60, "Time the way is clear before it is taken again."}},
          .states = {controllers::kStateNames.begin(), controllers::kStateNames.end()},
          .make_for_robot = hal::make_for_robot<controllers::HelpRobot>};
}
