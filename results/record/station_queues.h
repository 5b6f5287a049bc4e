#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables station_queues and station_queue_drops: the queues of stations that have one
/// for each receiver and access category.
class StationQueues final : public TopicWriter {
 public:
  explicit StationQueues(Database& database);

  static std::vector<Table> tables();

  void on_queue(hal::Time at, const sim::radio::QueueChange& change) override;

  /// Rewrites all rows, if anything changed. @param now  frames that still wait have waited until
  /// then.
  void write(hal::Time now) override;

 private:
  struct Queue {
    std::uint64_t frames = 0, waiting = 0, most = 0;
    std::uint64_t bytes = 0, most_bytes = 0;
    hal::Duration waited{};  ///< Total time of all frames, up to `since`.
    hal::Time since{};
    std::array<std::uint64_t, hal::kVerdictCount> dropped{};

    /// What waits now has its place.
    void settle() {
      most = std::max(most, waiting);
      most_bytes = std::max(most_bytes, bytes);
    }
    void wait_until(hal::Time at) {
      waited += static_cast<std::int64_t>(waiting) * (at - since);
      since = at;
    }
  };
  /// Agent, receiver, category.
  using Key = std::tuple<hal::AgentId, hal::AgentId, std::string_view>;

  Statement put_queue_, put_drops_;
  std::map<Key, Queue> queues_;
  bool changed_ = false;
};

}  // namespace results::record
