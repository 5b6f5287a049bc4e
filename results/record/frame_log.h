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
#include "sim/radio/mac/frame.h"
#include "sim/scenario/detail.h"

namespace results::record {

/// Writes the tables frames, msdus and frame_ends.
///
/// With Detail::kSample a frame is listed if fewer than kRowsOfSecond rows have been written for
/// the simulated second in which it begins; all its ends are then listed as well. So each second is
/// complete from its beginning up to some frame, and a quiet run has every frame.
class FrameLog final : public TopicWriter {
 public:
  static constexpr std::uint64_t kRowsOfSecond = 5000;

  /// @param detail  kSample or kAll
  /// @param protocols  outlives this object, as do all other references.
  FrameLog(Database& database, sim::scenario::Detail detail, const Protocols& protocols,
           Commits& commits);

  static std::vector<Table> tables();

  void on_frame_start(hal::Time at, const sim::radio::Frame& frame) override;
  void on_sinr(double sinr_db) override { sinr_db_ = sinr_db; }
  void on_reception(hal::Time at, const sim::radio::Frame& frame, hal::AgentId receiver,
                    hal::Verdict verdict, double rssi_dbm) override;

 private:
  bool takes(hal::Time at, const sim::radio::Frame& frame);
  void list_msdus(const sim::radio::Frame& frame);

  Statement insert_, insert_msdu_, insert_end_;
  sim::scenario::Detail detail_;
  const Protocols& protocols_;
  Commits& commits_;
  std::int64_t second_ = -1;
  std::uint64_t rows_ = 0;  ///< In that second.
  /// Frames of that second, and of the one in which frames began before it, that are not listed;
  /// their ends are not listed either, and may lie in the next second.
  std::set<std::uint64_t> left_out_, left_out_before_;
  double sinr_db_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace results::record
