#pragma once

#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"
#include "sim/physics/movable.h"

namespace results::record {

/// Writes the tables movables and movable_poses.
class MovableLog final : public TopicWriter {
 public:
  /// @param period  between two rows of a movable in movable_poses, > 0.
  MovableLog(Database& database, const std::vector<sim::physics::Movable>& movables,
             hal::Duration period, Commits& commits);

  static std::vector<Table> tables();

  void on_movable(hal::Time at, std::uint32_t number, const sim::physics::BodyPose& pose) override;
  /// Writes where those came to rest that have no row of it yet.
  void finish(hal::Time ended_at) override;

 private:
  struct Track {
    hal::Time next_row{};
    hal::Time at{};
    sim::physics::BodyPose pose;
    bool is_written = true;  ///< `pose` is in the table.
  };

  void write_row(std::uint32_t number, Track& track);

  hal::Duration period_;
  Statement insert_movable_, insert_pose_;
  Commits& commits_;
  std::vector<Track> tracks_;  ///< By number.
};

}  // namespace results::record
