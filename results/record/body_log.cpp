#include "results/record/body_log.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hal/types/check.h"
#include "hal/types/math.h"

namespace results::record {

BodyLog::BodyLog(Database& database, hal::Duration period, Commits& commits)
    : period_(period),
      insert_pose_(database, "REPLACE INTO poses VALUES (?, ?, ?, ?, ?)"),
      put_body_(database, "REPLACE INTO bodies VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      insert_lost_body_(database, "INSERT INTO lost_bodies VALUES (?, ?, ?)"),
      insert_contact_(database, "INSERT INTO contacts VALUES (?, ?, ?)"),
      commits_(commits) {
  BARAKA_CHECK(period > hal::Duration::zero());
}

void BodyLog::look_at(const sim::agents::Simulation& simulation) {
  look_at([&simulation](hal::AgentId agent) { return simulation.contacts(agent); });
}

void BodyLog::on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) {
  Track& track = track_of(agent);
  const Pose pose{body.x, body.y, body.theta};
  const bool jumped = std::exchange(track.displaced, false);
  const bool is_news =
      track.last != pose || body.clearance < track.clearance || body.tilt > track.tilt;
  if (!is_news) {
    write_pose(at, agent, track);
    return;
  }
  note_change(agent, track);
  if (track.last && !jumped)
    track.path += hal::math::hypot(pose.x - track.last->x, pose.y - track.last->y);
  track.last = pose;
  track.clearance = std::min(track.clearance, body.clearance);
  track.tilt = std::max(track.tilt, body.tilt);
  write_pose(at, agent, track);
}

BodyLog::Track& BodyLog::track_of(hal::AgentId agent) {
  if (agent.value >= tracks_.size()) tracks_.resize(agent.value + 1u);
  return tracks_[agent.value];
}

void BodyLog::note_change(hal::AgentId agent, Track& track) {
  if (!std::exchange(track.changed, true)) changed_.push_back(agent);
}

void BodyLog::write_pose(hal::Time at, hal::AgentId agent, Track& track) {
  if (at < track.next_row) return;
  // Rows are aligned to multiples of the period, whatever the phase of the control cycle is.
  const auto periods = at.time_since_epoch() / period_;
  track.next_row = hal::Time{(periods + 1) * period_};
  if (track.written == track.last) return;
  track.written = track.last;
  insert_pose_.run(agent.value, hal::to_ns(at), track.last->x, track.last->y, track.last->theta);
  // A body that has not moved since its last row was not pushed either; the body that pushes moves.
  commits_.on_rows(at, 1 + look_at_contacts(at, agent, track));
}

int BodyLog::look_at_contacts(hal::Time at, hal::AgentId agent, Track& track) {
  if (!contacts_) return 0;
  const sim::agents::ContactCounts now = contacts_(agent);
  const sim::agents::ContactCounts then = std::exchange(track.seen_contacts, now);
  return note_touch(at, agent, now.wall_steps > then.wall_steps, track.touches_wall, "wall") +
         note_touch(at, agent, now.object_steps > then.object_steps, track.touches_body, "body");
}

int BodyLog::note_touch(hal::Time at, hal::AgentId agent, bool touches, bool& before,
                        const char* other) {
  if (std::exchange(before, touches) || !touches) return 0;
  insert_contact_.run(agent.value, hal::to_ns(at), other);
  return 1;
}

void BodyLog::on_body_lost(const sim::physics::LostBody& lost) {
  insert_lost_body_.run(lost.agent.value, hal::to_ns(lost.at), sim::physics::name(lost.how));
  commits_.on_rows(lost.at, 1);
}

void BodyLog::add_contacts(hal::AgentId agent, const sim::agents::ContactCounts& contacts) {
  Track& track = track_of(agent);
  track.contacts = contacts;
  note_change(agent, track);
}

void BodyLog::write(hal::Time) {
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

std::vector<Table> BodyLog::tables() {
  return {
      {"poses",
       "poses of agents: one row per period (record: pose_period) for each agent that has moved "
       "since its last row",
       {{"agent", "INTEGER NOT NULL", "", "who"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"x_m", "REAL NOT NULL", "m", "place"},
        {"y_m", "REAL NOT NULL", "m", "place"},
        {"theta_rad", "REAL NOT NULL", "rad", "heading"}},
       "agent, at_ns"},
      {"bodies",
       "figures of the whole run, updated at each control instant",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"path_m", "REAL NOT NULL", "m", "travelled"},
        {"clearance_m", "REAL", "m",
         "least distance of the centre to a wall's surface; null: no wall"},
        {"tilt_rad", "REAL NOT NULL", "rad", "greatest"},
        {"x_m", "REAL NOT NULL", "m", "last place"},
        {"y_m", "REAL NOT NULL", "m", "last place"},
        {"theta_rad", "REAL NOT NULL", "rad", "last heading"},
        {"wall_steps", "INTEGER", "",
         "physics steps in contact with a wall; null until the run has ended"},
        {"object_steps", "INTEGER", "",
         "physics steps in contact with another body; null until the run has ended"}}},
      {"lost_bodies",
       "bodies that tipped over (by more than 1 rad) or left the world",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"what", "TEXT NOT NULL", "", "'tipped over', or how it was lost"}}},
  };
}

std::vector<Table> BodyLog::contact_tables() {
  return {
      {"contacts",
       "contacts of bodies: a row when a contact is seen at a row of the body in poses and was not "
       "seen at the row before",
       {{"agent", "INTEGER NOT NULL", "", "whose body"},
        {"at_ns", "INTEGER NOT NULL", "ns", "control instant"},
        {"other", "TEXT NOT NULL", "", "'wall', or 'body' of another agent"}}},
  };
}

}  // namespace results::record
