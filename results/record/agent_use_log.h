#pragma once

#include <cstdint>
#include <vector>

#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the table agent_use.
class AgentUseLog final : public TopicWriter {
 public:
  AgentUseLog(Database& database, bool counts_frames);

  static std::vector<Table> tables();

  /// Call once per agent, at the end of the run.
  void add(hal::AgentId agent, const sim::agents::AgentUse& use);

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;

 private:
  Statement insert_;
  bool counts_frames_;
  std::vector<std::uint64_t> retries_;  ///< By address of the transmitter.
};

}  // namespace results::record
