#include "results/record/commits.h"

namespace results::record {
namespace {

/// Up to kFewTotals rows of totals are few; so are more if there is at most one row per
/// kWorthWriting counted frames or messages. Writing a row takes about 2 us, counting about 10 ns.
constexpr std::uint64_t kFewTotals = 1000;
constexpr std::uint64_t kWorthWriting = 64;

}  // namespace

void Commits::on_rows(hal::Time at, int rows) {
  rows_ += rows;
  see(at);
  if (rows_ < kCommitRows && at < next_commit_) return;
  if (at >= next_commit_) {
    write_totals();
    next_commit_ = at + kCommitPeriod;
  }
  commit();
}

void Commits::write_totals() {
  for (const auto& writer : writers_) writer->write(now_);
}

bool Commits::has_few_totals() const {
  TopicWriter::Pending sum;
  for (const auto& writer : writers_) {
    const TopicWriter::Pending one = writer->pending();
    sum.rows += one.rows;
    sum.counted += one.counted;
  }
  return sum.rows <= kFewTotals + sum.counted / kWorthWriting;
}

void Commits::commit() {
  database_.execute("COMMIT; BEGIN");
  rows_ = 0;
}

}  // namespace results::record
