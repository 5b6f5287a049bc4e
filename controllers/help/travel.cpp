#include "controllers/help/travel.h"

#include "controllers/help/way_past.h"

namespace controllers {
namespace {

constexpr double kRoomToPass = 0.15;  // m between the body's edge and the centre of a mote

}  // namespace

std::vector<hal::ParameterSpec> Travel::parameters() {
  return {{"speed", "m/s", 0.94, 0.01, 5, "Speed of travel."},
          {"body_radius", "m", 0.185, 0.01, 2, "From the middle to the infrared sensors."},
          {"wall_gap", "m", 0.265, 0.1, 2, "Between the body and a wall it follows."},
          {"clear_for", "s", 1.2, 0, 60, "Time the way is clear before it is taken again."}};
}

Travel::Travel(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      clearance_(parameters["body_radius"] + kRoomToPass),
      avoidance_({.speed = parameters["speed"],
                  .body_radius = parameters["body_radius"],
                  .gap = parameters["wall_gap"],
                  .clear_for = hal::from_seconds(parameters["clear_for"])}) {}

void Travel::drive(hal::Vec2 to, double distance) {
  const auto infrared = robot_.infrared();
  const auto localised = robot_.reading("localisation");
  if (!infrared || !localised) return halt();
  const hal::Vec2 way = way_past(1 / distance * to, *localised, clearance_);
  (void)robot_.set_body_velocity(avoidance_.steer(way, *infrared, robot_.now()));
}

}  // namespace controllers
