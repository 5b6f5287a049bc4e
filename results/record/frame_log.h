#pragma once

#include <cstdint>
#include <limits>
#include <set>

#include "hal/types/verdict.h"
#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/protocols.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"
#include "sim/radio/frame.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// The tables frames and frame_ends.
///
/// With Detail::kSample a frame is listed while the simulated second in which it begins has fewer
/// than kRowsOfSecond rows, and then with all its ends: what is listed is listed whole, from the
/// begin of each second on, and a quiet run has every frame.
class FrameLog final : public TopicWriter {
 public:
  static constexpr std::uint64_t kRowsOfSecond = 5000;

  /// @param detail  kSample or kAll
  /// @param protocols  outlives it, as all that writers are given.
  FrameLog(Database& database, sim::scenario::Detail detail, const Protocols& protocols,
           Commits& commits);

  static std::vector<Table> tables();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_sinr(double sinr_db) override { sinr_db_ = sinr_db; }
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;

 private:
  bool takes(hal::Time at, const sim::radio::Frame& frame);

  Statement insert_, insert_end_;
  sim::scenario::Detail detail_;
  const Protocols& protocols_;
  Commits& commits_;
  std::int64_t second_ = -1;
  std::uint64_t rows_ = 0;  ///< Of that second.
  /// By transmitter its latest frame, if it was left out: its ends are, too. It can have one in the
  /// air, but a later one may begin while radios far away still hear the end of this.
  std::set<std::uint64_t> left_out_;
  double sinr_db_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace results::record
