#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"
#include "sim/air/refusal.h"

namespace results::record {

/// A program that ran inside an agent.
struct ProgramRow {
  hal::AgentId agent;
  std::string agent_name{};  ///< For messages; not in the table.
  std::string name;
  hal::Time started{};
  std::optional<hal::Time> ended{};  ///< None: it ended with the run.
  int status = 0;                    ///< 0..255; 128 + signal number if a signal ended it.
};

/// Writes the tables programs and interfaces; the latter counts the frames between programs and the
/// air, by agent and by outcome.
class InterfaceCounts final : public TopicWriter {
 public:
  explicit InterfaceCounts(Database& database);

  static std::vector<Table> tables();

  void add(const ProgramRow& program);

  void on_air_entered(hal::Time at, hal::AgentId agent,
                      const sim::radio::MacRequest& request) override;
  void on_air_left(hal::Time at, hal::AgentId agent,
                   const sim::radio::MacIndication& indication) override;
  void on_air_refused(hal::Time, hal::AgentId agent, sim::air::Refusal refusal,
                      std::size_t bytes) override {
    add(agent, kFirstRefusal + static_cast<std::size_t>(refusal), bytes);
  }

  /// Rewrites all rows, if a count changed.
  void write(hal::Time now) override;

 private:
  static constexpr std::size_t kEntered = 0, kLeft = 1, kFirstRefusal = 2,
                               kKinds = kFirstRefusal + sim::air::kRefusals;
  struct Count {
    std::uint64_t frames = 0, bytes = 0;
  };
  void add(hal::AgentId agent, std::size_t kind, std::size_t bytes) {
    Count& count = counts_[agent][kind];
    ++count.frames;
    count.bytes += bytes;
    changed_ = true;
  }

  Statement put_, insert_program_;
  std::map<hal::AgentId, std::array<Count, kKinds>> counts_;
  bool changed_ = false;
};

}  // namespace results::record
