#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/time.h"
#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// Writes the tables readings and queues: sensor readings and queue lengths, a row for each change.
class LookLog final : public TopicWriter {
 public:
  struct Settings {
    hal::Duration period{};  ///< Minimum time between two rows of a channel, > 0.
    /// kSample: only range sensors and bumpers with at most kFewValues values. Their values change
    /// seldom; voltages and odometry change all the time.
    sim::scenario::Detail readings = sim::scenario::Detail::kNone;
    bool queues = false;
  };
  static constexpr std::size_t kFewValues = 32;

  LookLog(Database& database, Settings settings, Commits& commits);

  static std::vector<Table> tables();

  /// Queues are recorded only after this call.
  void look_at(const sim::agents::Simulation& simulation) override;
  /// @param queue  returns the number of frames that wait at an agent's radio.
  void look_at(std::function<std::uint64_t(hal::AgentId)> queue) { queue_ = std::move(queue); }

  bool observes_readings() const override {
    return settings_.readings != sim::scenario::Detail::kNone;
  }
  bool observes(hal::AgentId agent, const hal::Channel& channel) const override;

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override;
  void on_reading(hal::Time at, hal::AgentId agent, const hal::Channel& channel,
                  std::span<const double> values) override;

 private:
  struct Sensed {
    hal::Time next_row{};
    std::string written;
  };
  struct Agent {
    std::uint64_t queue = 0;
    std::vector<Sensed> channels;  ///< By id of the channel.
  };
  Agent& agent(hal::AgentId id);
  void look_at_queue(hal::Time at, hal::AgentId id);

  Statement insert_reading_, insert_queue_;
  Settings settings_;
  std::function<std::uint64_t(hal::AgentId)> queue_;
  Commits& commits_;
  std::vector<Agent> agents_;  ///< By address.
};

}  // namespace results::record
