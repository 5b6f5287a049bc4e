#include "results/record/body_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace results::record {

BodyLog::BodyLog(Database& database, hal::Duration period)
    : period_(period),
      insert_pose_(database, "REPLACE INTO poses VALUES (?, ?, ?, ?, ?)"),
      put_body_(database, "REPLACE INTO bodies VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)") {
  BARAKA_CHECK(period > hal::Duration::zero());
}

bool BodyLog::on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) {
  Track& track = track_of(agent);
  const Pose pose{body.x, body.y, body.theta};
  const bool jumped = std::exchange(track.displaced, false);
  const bool is_news =
      track.last != pose || body.clearance < track.clearance || body.tilt > track.tilt;
  if (!is_news) return write_pose(at, agent, track);
  note_change(agent, track);
  if (track.last && !jumped)
    track.path += hal::math::hypot(pose.x - track.last->x, pose.y - track.last->y);
  track.last = pose;
  track.clearance = std::min(track.clearance, body.clearance);
  track.tilt = std::max(track.tilt, body.tilt);
  return write_pose(at, agent, track);
}

BodyLog::Track& BodyLog::track_of(hal::AgentId agent) {
  if (agent.value >= tracks_.size()) tracks_.resize(agent.value + 1u);
  return tracks_[agent.value];
}

void BodyLog::note_change(hal::AgentId agent, Track& track) {
  if (!std::exchange(track.changed, true)) changed_.push_back(agent);
}

bool BodyLog::write_pose(hal::Time at, hal::AgentId agent, Track& track) {
  if (at < track.next_row) return false;
  // Rows stay on the grid of the period, however a control cycle is phased.
  const auto periods = at.time_since_epoch() / period_;
  track.next_row = hal::Time{(periods + 1) * period_};
  if (track.written == track.last) return false;
  track.written = track.last;
  insert_pose_.run(agent.value, hal::to_ns(at), track.last->x, track.last->y, track.last->theta);
  return true;
}

void BodyLog::on_contacts(hal::AgentId agent, const sim::agents::ContactCounts& contacts) {
  Track& track = track_of(agent);
  track.contacts = contacts;
  note_change(agent, track);
}

void BodyLog::write() {
  std::ranges::sort(changed_);
  for (const hal::AgentId agent : changed_) {
    Track& track = tracks_[agent.value];
    track.changed = false;
    if (!track.last) continue;
    std::optional<double> clearance;
    if (std::isfinite(track.clearance)) clearance = track.clearance;
    std::optional<std::uint64_t> walls;
    std::optional<std::uint64_t> objects;
    if (track.contacts) {
      walls = track.contacts->wall_steps;
      objects = track.contacts->object_steps;
    }
    put_body_.run(agent.value, track.path, clearance, track.tilt, track.last->x, track.last->y,
                  track.last->theta, walls, objects);
  }
  changed_.clear();
}

}  // namespace results::record
