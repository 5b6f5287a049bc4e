#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables relays and relay_queues: what access points did with frames that stations sent
/// through them, and the queues of access points by destination.
class RelayCounts final : public TopicWriter {
 public:
  explicit RelayCounts(Database& database);

  static std::vector<Table> tables();

  void on_relay_queued(hal::Time at, const sim::radio::Msdu& msdu) override;
  void on_msdu_end(hal::Time at, const sim::radio::Msdu& msdu,
                   const sim::radio::MsduEnd& end) override;

  /// Rewrites all rows, if anything changed. @param now  frames that still wait have waited until
  /// then.
  void write(hal::Time now) override;

 private:
  static constexpr std::size_t kTransmitted = hal::kVerdictCount, kOverWire = kTransmitted + 1,
                               kOutcomes = kOverWire + 1;
  struct Flow {
    std::array<std::uint64_t, kOutcomes> ended{};
    std::uint64_t waiting = 0;
  };
  struct Queue {
    std::uint64_t frames = 0, waiting = 0, most = 0;
    hal::Duration waited{};  ///< Total time of all frames, up to `since`.
    hal::Time since{};

    void wait_until(hal::Time at) {
      waited += static_cast<std::int64_t>(waiting) * (at - since);
      since = at;
    }
  };
  /// Access point, source, destination.
  using FlowKey = std::tuple<hal::AgentId, hal::AgentId, hal::AgentId>;
  using QueueKey = std::pair<hal::AgentId, hal::AgentId>;  ///< Access point, destination.

  void write_flows();

  Statement put_relay_, forget_waiting_, put_queue_;
  std::map<FlowKey, Flow> flows_;
  std::map<QueueKey, Queue> queues_;
  bool changed_ = false;
};

}  // namespace results::record
