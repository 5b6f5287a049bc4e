#include "results/record/movable_log.h"

#include <array>
#include <string_view>

#include "hal/types/check.h"

namespace results::record {
namespace {

constexpr std::array<std::string_view, 3> kForms{"box", "cylinder", "sphere"};

}  // namespace

MovableLog::MovableLog(Database& database, const std::vector<sim::physics::Movable>& movables,
                       hal::Duration period, Commits& commits)
    : period_(period),
      insert_movable_(database, "INSERT INTO movables VALUES (?, ?, ?, ?, ?, ?, ?)"),
      insert_pose_(database, "REPLACE INTO movable_poses VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"),
      commits_(commits),
      tracks_(movables.size()) {
  BARAKA_CHECK(period > hal::Duration::zero());
  for (std::size_t i = 0; i < movables.size(); ++i) {
    const hal::Vec3 size = sim::physics::extents(movables[i]);
    insert_movable_.run(std::uint64_t{i}, movables[i].name, kForms.at(movables[i].form.index()),
                        size.x, size.y, size.z, movables[i].mass);
  }
}

void MovableLog::on_movable(hal::Time at, std::uint32_t number,
                            const sim::physics::BodyPose& pose) {
  Track& track = tracks_[number];
  track.pose = pose;
  track.at = at;
  track.is_written = false;
  if (at >= track.next_row) write_row(number, track);
}

void MovableLog::write_row(std::uint32_t number, Track& track) {
  track.next_row = hal::Time{(track.at.time_since_epoch() / period_ + 1) * period_};
  track.is_written = true;
  const hal::Vec3& p = track.pose.position;
  const auto& q = track.pose.quaternion;
  insert_pose_.run(std::uint64_t{number}, hal::to_ns(track.at), p.x, p.y, p.z, q[0], q[1], q[2],
                   q[3]);
  commits_.on_rows(track.at, 1);
}

void MovableLog::finish(hal::Time /*ended_at*/) {
  for (std::uint32_t number = 0; number < tracks_.size(); ++number)
    if (!tracks_[number].is_written) write_row(number, tracks_[number]);
}

std::vector<Table> MovableLog::tables() {
  return {
      {"movables",
       "the movables of the run",
       {{"movable", "INTEGER PRIMARY KEY", "", "number, from 0"},
        {"name", "TEXT NOT NULL", "", "for display"},
        {"form", "TEXT NOT NULL", "", "'box', 'cylinder' or 'sphere'"},
        {"size_x_m", "REAL NOT NULL", "m", "length along its own x axis"},
        {"size_y_m", "REAL NOT NULL", "m", "length along its own y axis"},
        {"size_z_m", "REAL NOT NULL", "m", "length along its own z axis"},
        {"mass_kg", "REAL NOT NULL", "kg", "mass"}}},
      {"movable_poses",
       "poses of movables: at the start, one row per period (record: pose_period) for each movable "
       "that has moved since its last row, and where it came to rest",
       {{"movable", "INTEGER NOT NULL", "", "which"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"x_m", "REAL NOT NULL", "m", "centre"},
        {"y_m", "REAL NOT NULL", "m", "centre"},
        {"z_m", "REAL NOT NULL", "m", "centre"},
        {"qw", "REAL NOT NULL", "", "quaternion, from its own axes to the world's"},
        {"qx", "REAL NOT NULL", "", "its x"},
        {"qy", "REAL NOT NULL", "", "its y"},
        {"qz", "REAL NOT NULL", "", "its z"}},
       "movable, at_ns"},
  };
}

}  // namespace results::record
