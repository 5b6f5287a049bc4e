#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

#include "hal/types/time.h"
#include "results/record/database.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Owns the writers of a run and commits what they wrote: every kCommitPeriod of simulated time and
/// every kCommitRows rows. The time is looked at when a row is written and when a frame begins or
/// ends.
class Commits final : public sim::agents::Observer {
 public:
  static constexpr hal::Duration kCommitPeriod = std::chrono::seconds{10};
  static constexpr int kCommitRows = 20000;

  /// @param database  must be in a transaction whenever something is written or committed.
  explicit Commits(Database& database) : database_(database) {}

  void add(std::unique_ptr<TopicWriter> writer) { writers_.push_back(std::move(writer)); }
  const std::vector<std::unique_ptr<TopicWriter>>& writers() const { return writers_; }

  /// Called after rows were written; may commit. @param rows  their number.
  void on_rows(hal::Time at, int rows);
  /// Called when something was counted that totals include.
  void see(hal::Time at) { now_ = std::max(now_, at); }
  hal::Time now() const { return now_; }  ///< Time of the latest row, or of the end of the run.

  void write_totals();
  /// Whether the totals have few rows compared with what they count.
  bool has_few_totals() const;
  void commit();

  void on_frame_start(hal::Time at, const sim::radio::Frame&) override { on_rows(at, 0); }
  void on_request_end(hal::Time at, hal::AgentId, hal::AgentId, hal::Verdict) override {
    on_rows(at, 0);
  }

 private:
  Database& database_;
  std::vector<std::unique_ptr<TopicWriter>> writers_;
  int rows_ = 0;  ///< Since the last commit.
  hal::Time now_{};
  hal::Time next_commit_{kCommitPeriod};
};

}  // namespace results::record
