#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "results/record/database.h"
#include "sim/agents/observer.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// The tables readings, queues and contacts: what is looked at while agents move and talk, a row
/// for each change.
class LookLog {
 public:
  /// What there is to look at.
  struct Eyes {
    std::function<std::uint64_t(hal::AgentId)> queue;  ///< Frames.
    std::function<sim::agents::ContactCounts(hal::AgentId)> contacts;
  };
  struct Settings {
    hal::Duration period{};  ///< Between two readings of a channel, > 0.
    sim::scenario::Detail readings =
        sim::scenario::Detail::kNone;  ///< kSample: ranges and bumpers of at most kFewValues
                                       ///< values.
    ///< They say the same for most of the time; voltages and odometry never do.
    bool queues = false;
  };
  static constexpr std::size_t kFewValues = 32;

  LookLog(Database& database, Settings settings);

  /// Before the run; until then queues and contacts are not seen.
  void open(Eyes eyes) { eyes_ = std::move(eyes); }

  bool observes_readings() const { return settings_.readings != sim::scenario::Detail::kNone; }
  bool observes(const hal::Channel& channel) const;

  /// Something was sent, or has ended, at the agent's radio. @return rows written, as of the
  /// others.
  int on_queue(hal::Time at, hal::AgentId agent);
  /// A control instant of a body that moves.
  int on_body(hal::Time at, hal::AgentId agent);
  int on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                 std::span<const double> values);

 private:
  struct Sensed {
    hal::Time next_row{};
    std::string written;
  };
  struct Agent {
    std::uint64_t queue = 0;
    sim::agents::ContactCounts contacts;
    bool touches_wall = false, touches_body = false;
    std::vector<Sensed> channels;  ///< By id.
  };
  Agent& agent(hal::AgentId id);
  int note_touch(hal::Time at, hal::AgentId id, bool touches, bool& before, const char* other);

  Statement insert_reading_, insert_queue_, insert_contact_;
  Settings settings_;
  Eyes eyes_;
  std::vector<Agent> agents_;  ///< By address.
};

}  // namespace results::record
