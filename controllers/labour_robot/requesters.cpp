#include "controllers/labour_robot/requesters.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "controllers/help_message.h"
#include "hal/types/math.h"

namespace controllers {
namespace {

/// r of the best route; 0: no route is known.
double value_of(const hal::Robot& robot, hal::AgentId mote, const hal::PathMetric& metric) {
  double best = 0;
  for (const hal::Route& route : robot.network().routes(kHelpTopic, mote)) {
    best = std::max(best, hal::path_value(metric, route.path, route.next_hop == mote));
  }
  return best;
}

}  // namespace

void Requesters::forget_before(hal::Time time) {
  std::erase_if(last_heard_, [time](const auto& one) { return one.second < time; });
}

hal::AgentId Requesters::draw(hal::Robot& robot, hal::PathMetric metric, double beta) const {
  metric.direct_weight = 0;
  std::vector<std::pair<hal::AgentId, double>> values;
  double best = 0, worst = 0;
  for (const auto& [mote, time] : last_heard_) {
    const double value = values.emplace_back(mote, value_of(robot, mote, metric)).second;
    best = std::max(best, value);
    if (value > 0) worst = worst > 0 ? std::min(worst, value) : value;
  }
  if (best == 0) best = worst = 1;
  double sum = 0;
  for (auto& [mote, value] : values) {
    // Relative to the best, so that no power overflows.
    value = hal::math::pow((value > 0 ? value : worst) / best, beta);
    sum += value;
  }
  double left = robot.random().uniform() * sum;
  for (const auto& [mote, value] : values) {
    left -= value;
    if (left < 0) return mote;
  }
  return values.back().first;  // rounding left a remainder
}

}  // namespace controllers
