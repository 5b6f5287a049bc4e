#include "baraka/run/topics/marker_publisher.h"

#include "sim/agents/drawn_bodies.h"

namespace baraka::run::topics {
namespace {

using namespace std::chrono_literals;

// Periods of simulated time.
constexpr hal::Duration kBodyPeriod = 100ms;
constexpr hal::Duration kAllPeriod = 1s;

}  // namespace

MarkerPublisher::MarkerPublisher(const sim::agents::SimulationConfig& config) {
  for (const auto& wall : config.walls) walls_.push_back(sim::agents::drawn_body(wall));
  for (const auto& agent : config.agents) {
    bodies_[agent.id].drawn = sim::agents::drawn_body(agent);
  }
}

void MarkerPublisher::start(gateway::inspection::InspectionParticipant& participant) {
  inspector_ = std::make_unique<gateway::inspection::MarkerInspector>(participant);
}

bool MarkerPublisher::is_read() {
  const int readers = inspector_ ? inspector_->readers() : 0;
  if (readers > readers_) all_shown_at_ = hal::Time{kNever};
  if (readers == 0 && readers_ > 0) {
    for (auto& [id, body] : bodies_) body.is_known = false;
  }
  readers_ = readers;
  return readers > 0;
}

void MarkerPublisher::on_body(hal::Time at, hal::AgentId agent, const hal::Pose2& pose) {
  if (!is_read()) return;
  if (at > now_ && now_ >= shown_at_ + kBodyPeriod) show();
  now_ = at;
  Body& body = bodies_.at(agent);
  body.has_moved = body.has_moved || !body.is_known || pose != body.pose;
  body.pose = pose;
  body.is_known = true;
}

void MarkerPublisher::show() {
  const bool all = now_ >= all_shown_at_ + kAllPeriod;
  if (all) {
    for (const hal::DrawnBody& wall : walls_) inspector_->add(now_, wall, {});
    all_shown_at_ = now_;
  }
  for (auto& [id, body] : bodies_) {
    if (!body.is_known || !(all || body.has_moved)) continue;
    inspector_->add(now_, body.drawn, body.pose);
    body.has_moved = false;
  }
  inspector_->publish();
  shown_at_ = now_;
}

}  // namespace baraka::run::topics
