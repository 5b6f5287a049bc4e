#include "controllers/help/help_trip.h"

#include <utility>

#include "hal/types/math.h"

namespace controllers {
namespace {

std::vector<std::string> statistic_names() {
  std::vector<std::string> names;
  names.reserve(hal::kPathStatistics.size());
  for (const hal::PathStatistic one : hal::kPathStatistics) names.emplace_back(hal::name(one));
  return names;
}

hal::PathMetric metric_of(const std::string& statistic, double direct_weight) {
  return hal::path_metric(hal::path_statistic(statistic).value_or(hal::PathStatistic::kHops),
                          direct_weight);
}

}  // namespace

std::vector<hal::ParameterSpec> HelpTrip::parameters(const std::string& prefix) {
  constexpr double kHour = 3600;  // s
  return {
      {prefix + "keep_alive", "s", 15, 1, kHour, "Time between two messages to the mote."},
      {prefix + "hop_timeout", "s", 300, 1, kHour, "Time for one hop before it gives up."},
      {prefix + "reply_timeout", "s", 30, 1, kHour, "Time for an answer before it asks again."},
      {prefix + "max_repeats", "1", 3, 0, 1000, "Questions after the first one."},
      {prefix + "near", "m", 10, 0.5, 1000, "Asks for the next hop, or has arrived, below this."},
      {prefix + "reached", "m", 4, 0.5, 1000, "A hop has been reached below this."},
      {.name = prefix + "metric",
       .default_value = "hops",
       .meaning = "Of the path behind a hop: what makes it a good one.",
       .choices = statistic_names()},
      {prefix + "direct_weight", "1", 1e6, 0, 1e12,
       "Stands for the metric of a hop that is the mote itself; 0: nothing does."},
      {prefix + "beta", "1", 2, 1, 20, "Exponent of the metric."}};
}

HelpTrip::HelpTrip(hal::Robot& robot, Travel& travel, const hal::Parameters& parameters,
                   const std::string& prefix)
    : robot_(robot),
      travel_(travel),
      keep_alive_(hal::from_seconds(parameters[prefix + "keep_alive"])),
      hop_timeout_(hal::from_seconds(parameters[prefix + "hop_timeout"])),
      reply_timeout_(hal::from_seconds(parameters[prefix + "reply_timeout"])),
      max_repeats_(static_cast<int>(parameters[prefix + "max_repeats"])),
      near_(parameters[prefix + "near"]),
      reached_(parameters[prefix + "reached"]),
      metric_(metric_of(parameters.text(prefix + "metric"), parameters[prefix + "direct_weight"])),
      beta_(parameters[prefix + "beta"]) {}

void HelpTrip::begin(hal::AgentId mote) {
  enter(State::kSelectDestination);
  destination_ = mote;
  left_.reset();
  has_arrived_ = was_refused_ = false;
  request(State::kRequestAssignment);
}

void HelpTrip::step() {
  if (state_ == State::kRequestAssignment || state_ == State::kRequestNextHop) {
    return wait_for_answer();
  }
  if (is_under_way()) go();
}

void HelpTrip::receive(hal::AgentId from, HelpWord word) {
  if (!is_to(from)) return;
  if (word == HelpWord::kGrant) on_answer(true);
  if (word == HelpWord::kRefuse) on_answer(false);
}

bool HelpTrip::is_under_way() const {
  return state_ == State::kGoToNextHop || state_ == State::kGoToDestination;
}

/// Sends a request to the destination and waits in `state` for its answer, or for the routes that
/// the request discovers.
void HelpTrip::request(State state) {
  travel_.halt();
  repeats_ = 0;
  deadline_ = robot_.now() + reply_timeout_;
  say(HelpWord::kAsk);
  enter(state);
}

void HelpTrip::wait_for_answer() {
  if (state_ == State::kRequestNextHop && !routes_ahead().empty()) return find_next_hop();
  if (robot_.now() < deadline_) return;
  if (repeats_ == max_repeats_) return give_up();
  ++repeats_;
  deadline_ = robot_.now() + reply_timeout_;
  // Without an answer, the route in one direction is not what the network assumes. A new search
  // updates both directions at the nodes on the path.
  (void)robot_.network().invalidate(kHelpTopic, destination_);
  say(HelpWord::kAsk);
}

void HelpTrip::on_answer(bool granted) {
  if (!granted) {
    was_refused_ = true;
    travel_.halt();
    return enter(State::kIdle);
  }
  if (state_ == State::kRequestAssignment ||
      (state_ == State::kRequestNextHop && !routes_ahead().empty())) {
    find_next_hop();
  }
}

/// Routes to the destination that do not lead back to the hop at which the robot stands.
std::vector<hal::Route> HelpTrip::routes_ahead() const {
  auto routes = std::as_const(robot_).network().routes(kHelpTopic, destination_);
  std::erase_if(routes, [this](const hal::Route& route) {
    return route.next_hop == left_ && route.next_hop != destination_;
  });
  return routes;
}

void HelpTrip::find_next_hop() {
  enter(State::kFindNextHop);
  const auto routes = routes_ahead();
  if (routes.empty()) {
    // Remaining routes can only lead back here: they must not prevent a new search.
    (void)robot_.network().invalidate(kHelpTopic, destination_);
    return request(State::kRequestNextHop);
  }
  next_hop_ = routes[hal::draw_route(routes, metric_, beta_, robot_.random())].next_hop;
  deadline_ = robot_.now() + hop_timeout_;
  keep_alive_at_ = robot_.now() + keep_alive_;
  asked_near_ = false;
  travel_.aim_anew();
  enter(next_hop_ == destination_ ? State::kGoToDestination : State::kGoToNextHop);
}

void HelpTrip::go() {
  if (robot_.now() >= deadline_) return give_up();
  const auto to = robot_.relative_position(next_hop_);
  // Not localised: wait, until it is or the time is up.
  if (!to) return travel_.halt();
  const double distance = hal::math::hypot(to->x, to->y);
  if (state_ == State::kGoToDestination && distance < near_) return arrive();
  if (state_ == State::kGoToNextHop && distance < reached_) {
    left_ = next_hop_;
    return find_next_hop();
  }
  keep_in_touch(distance);
  travel_.drive(*to, distance);
}

/// Tells the mote that the robot is still coming. On the way to a hop this also renews the route,
/// so that the network follows the robot's position.
void HelpTrip::keep_in_touch(double distance) {
  const bool to_hop = state_ == State::kGoToNextHop;
  const bool comes_near = to_hop && !asked_near_ && distance < near_;
  if (!comes_near && robot_.now() < keep_alive_at_) return;
  if (comes_near) asked_near_ = true;
  keep_alive_at_ = robot_.now() + keep_alive_;
  if (to_hop) (void)robot_.network().invalidate(kHelpTopic, destination_);
  say(HelpWord::kAsk);
}

void HelpTrip::give_up() {
  travel_.halt();
  enter(State::kGiveUp);
  say(HelpWord::kGiveUp);
  enter(State::kIdle);
}

void HelpTrip::arrive() {
  travel_.halt();
  say(HelpWord::kArrived);
  enter(State::kArrived);
  has_arrived_ = true;
  enter(State::kIdle);
}

void HelpTrip::say(HelpWord word) {
  // The HAL logs what it refuses; a lost request is repeated.
  (void)robot_.send(destination_, kHelpTopic, encode({.word = word, .max_hop = hop_timeout_}));
}

void HelpTrip::enter(State state) {
  state_ = state;
  robot_.state(kStateNames[static_cast<std::size_t>(state)]);
}

}  // namespace controllers
