#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables poses, bodies, lost_bodies and contacts.
class BodyLog final : public TopicWriter {
 public:
  /// @param period  between two rows of a body in poses, > 0.
  BodyLog(Database& database, hal::Duration period, Commits& commits);

  static std::vector<Table> tables();
  static std::vector<Table> contact_tables();

  using Contacts = std::function<sim::agents::ContactCounts(hal::AgentId)>;
  /// Contacts are recorded only after this call.
  void look_at(const sim::agents::Simulation& simulation) override;
  void look_at(Contacts contacts) { contacts_ = std::move(contacts); }

  void on_body(hal::Time at, hal::AgentId agent, const sim::agents::BodyState& body) override;
  /// A displaced body jumps: the distance between the two poses does not count as travelled.
  void on_displaced(hal::Time, hal::AgentId agent) override { track_of(agent).displaced = true; }
  void on_body_lost(const sim::physics::LostBody& lost) override;
  /// Call at the end of the run.
  void add_contacts(hal::AgentId agent, const sim::agents::ContactCounts& contacts);

  void write(hal::Time now) override;

 private:
  struct Pose {
    double x = 0, y = 0, theta = 0;
    bool operator==(const Pose&) const = default;
  };
  /// What is kept of a body. The first cache line holds all that is read for a body that has not
  /// moved.
  struct alignas(64) Track {
    std::optional<Pose> last;  ///< At the latest control instant.
    hal::Time next_row{};
    double clearance = std::numeric_limits<double>::infinity();
    double tilt = 0;
    bool changed = false;    ///< Since its row in bodies was written.
    bool displaced = false;  ///< Since the last on_body().

    std::optional<Pose> written;  ///< Latest row in poses.
    double path = 0;
    std::optional<sim::agents::ContactCounts> contacts;  ///< Counts over the whole run.
    sim::agents::ContactCounts seen_contacts;
    bool touches_wall = false, touches_body = false;
  };

  Track& track_of(hal::AgentId agent);
  void note_change(hal::AgentId agent, Track& track);
  int note_touch(hal::Time at, hal::AgentId agent, bool touches, bool& before, const char* other);
  int look_at_contacts(hal::Time at, hal::AgentId agent, Track& track);
  void write_pose(hal::Time at, hal::AgentId agent, Track& track);

  hal::Duration period_;
  Statement insert_pose_, put_body_, insert_lost_body_, insert_contact_;
  Contacts contacts_;
  Commits& commits_;
  std::vector<Track> tracks_;          ///< By address.
  std::vector<hal::AgentId> changed_;  ///< Agents whose tracks changed.
};

}  // namespace results::record
