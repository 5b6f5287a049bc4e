#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>

#include "hal/types/agent_id.h"
#include "results/record/database.h"
#include "sim/air/refusal.h"

namespace results::record {

/// The table interfaces: frames between the programs and the air, by agent and what became of them.
class InterfaceCounts {
 public:
  explicit InterfaceCounts(Database& database);

  void on_entered(hal::AgentId agent, std::size_t bytes) { add(agent, kEntered, bytes); }
  void on_left(hal::AgentId agent, std::size_t bytes) { add(agent, kLeft, bytes); }
  void on_refused(hal::AgentId agent, sim::air::Refusal refusal, std::size_t bytes) {
    add(agent, kFirstRefusal + static_cast<std::size_t>(refusal), bytes);
  }

  /// Writes all rows anew.
  void write();

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

  Statement put_;
  std::map<hal::AgentId, std::array<Count, kKinds>> counts_;
  bool changed_ = false;
};

}  // namespace results::record
