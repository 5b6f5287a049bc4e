#pragma once

#include <cstdint>
#include <vector>

#include "results/record/database.h"
#include "results/record/pair_counts.h"
#include "sim/radio/observer.h"

namespace results::record {

/// The tables frames_sent, receptions, faint, packets and requests.
class FrameCounts {
 public:
  explicit FrameCounts(Database& database);

  void on_frame_start(const sim::radio::Frame& frame);
  void on_faint(const sim::radio::Frame& frame, std::uint32_t radios);
  void on_reception(const sim::radio::Frame& frame, hal::AgentId receiver, hal::Verdict verdict);
  void on_delivered(const sim::radio::Frame& frame, hal::AgentId receiver);
  void on_request_end(hal::AgentId sender, hal::AgentId destination, hal::Verdict verdict);

  /// Writes a row for each count that changed since the last call.
  void write();

  std::uint64_t retries(hal::AgentId agent) const {
    return agent.value < retries_.size() ? retries_[agent.value] : 0;
  }

  std::uint64_t counted() const;  ///< Since the last write(), and
  std::uint64_t rows() const;     ///< how many rows it would write.

 private:
  Statement put_sent_, put_reception_, put_faint_, put_packet_, put_request_;
  PairCounts sent_;
  PairCounts receptions_;  ///< And packets: where the one is, the other is near.
  PairCounts requests_;
  std::vector<std::uint64_t> faint_;    ///< By address of the transmitter, as
  std::vector<std::uint64_t> retries_;  ///< these.
};

}  // namespace results::record
