#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "results/record/database.h"
#include "sim/agents/observer.h"

namespace results::record {

/// The tables poses and bodies.
class BodyLog {
 public:
  /// @param period  of the rows in poses, > 0.
  BodyLog(Database& database, hal::Duration period);

  /// @return whether a row was written.
  bool on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body);
  /// The way from where it was to where it is found next is none that it went.
  void on_displaced(hal::AgentId agent) { track_of(agent).displaced = true; }
  void on_contacts(hal::AgentId agent, const sim::agents::ContactCounts& contacts);

  /// Writes the row in bodies of each one of which something changed since the last call.
  void write();

 private:
  struct Pose {
    double x = 0, y = 0, theta = 0;
    bool operator==(const Pose&) const = default;
  };
  /// In a cache line of its own what is looked at of a body that has not moved.
  struct alignas(64) Track {
    std::optional<Pose> last;  ///< At the latest control instant.
    hal::Time next_row{};
    double clearance = std::numeric_limits<double>::infinity();
    double tilt = 0;
    bool changed = false;    ///< Since its row in bodies was written.
    bool displaced = false;  ///< Since it was seen last.

    std::optional<Pose> written;  ///< Latest row in poses.
    double path = 0;
    std::optional<sim::agents::ContactCounts> contacts;
  };

  Track& track_of(hal::AgentId agent);
  void note_change(hal::AgentId agent, Track& track);
  bool write_pose(hal::Time at, hal::AgentId agent, Track& track);

  hal::Duration period_;
  Statement insert_pose_, put_body_;
  std::vector<Track> tracks_;          ///< By address.
  std::vector<hal::AgentId> changed_;  ///< Those whose tracks did.
};

}  // namespace results::record
