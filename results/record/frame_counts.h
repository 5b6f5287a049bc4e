#pragma once

#include <cstdint>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/frames_in_the_air.h"
#include "results/record/pair_counts.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"
#include "sim/radio/radio_config.h"

namespace results::record {

/// Writes the tables frames_sent, receptions, faint, packets and requests, those of FramesInTheAir,
/// and the views of all of them.
class FrameCounts final : public TopicWriter {
 public:
  FrameCounts(Database& database, const sim::radio::RadioConfig& radio, Commits& commits);

  static std::vector<Table> sent_tables();
  static std::vector<Table> end_tables();
  static std::vector<Table> link_views();
  static std::vector<Table> sum_views();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_frame_cut(hal::Time at, const sim::radio::Frame& frame) override {
    in_the_air_.on_frame_cut(at, frame);
  }
  void on_faint(const sim::radio::Frame& frame, std::uint32_t radios) override;
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;
  void on_delivered(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver) override;
  void on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId destination,
                      hal::Verdict verdict) override;

  void write(hal::Time now) override;
  Pending pending() const override;

 private:
  Statement put_sent_, put_reception_, put_faint_, put_packet_, put_request_;
  PairCounts sent_;
  /// Also the packets: both have the same pair of agents, so they are close in memory.
  PairCounts receptions_;
  PairCounts requests_;
  hal::AgentId heard_{};              ///< Transmitter of the last reception.
  std::vector<std::uint64_t> faint_;  ///< By address of the transmitter.
  FramesInTheAir in_the_air_;
  Commits& commits_;
};

}  // namespace results::record
