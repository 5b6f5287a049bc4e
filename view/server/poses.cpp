#include <algorithm>
#include <tuple>
#include <vector>

#include "view/server/tiles.h"

namespace view::server {
namespace {

using results::record::Statement;

struct PoseRow {
  std::int64_t at, agent;
  double x, y, theta;
};

/// Collects rows of poses, one agent after the other.
class PoseRows {
 public:
  explicit PoseRows(Record& record)
      : count_(record.query("SELECT COUNT(*) FROM (SELECT 1 FROM poses WHERE agent = ? AND "
                            "at_ns >= ? AND at_ns < ? LIMIT ?)")),
        span_(record.query("SELECT at_ns, agent, x_m, y_m, theta_rad FROM poses WHERE agent = ? "
                           "AND at_ns >= ? AND at_ns < ? ORDER BY at_ns LIMIT ?")),
        before_(record.query("SELECT at_ns, agent, x_m, y_m, theta_rad FROM poses WHERE agent = ? "
                             "AND at_ns < ? ORDER BY at_ns DESC LIMIT 1")),
        start_(record.query("SELECT 0, agent, x_m, y_m, theta_rad FROM agents WHERE agent = ?")) {}

  std::int64_t count(std::int64_t agent, const Span& span, std::int64_t most) {
    count_.bind_all(agent, span.from(), span.to(), most);
    std::int64_t found = 0;
    while (count_.next()) found = count_.integer(0);
    return found;
  }

  /// Adds at most `most` rows with from <= at < to.
  void add(std::int64_t agent, std::int64_t from, std::int64_t to, std::int64_t most) {
    span_.bind_all(agent, from, to, most);
    while (span_.next()) take(span_);
  }

  /// Adds the agent's last row before `from`, or else its start pose.
  void add_before(std::int64_t agent, std::int64_t from) {
    const std::size_t had = rows.size();
    before_.bind_all(agent, from);
    while (before_.next()) take(before_);
    if (rows.size() != had) return;
    start_.bind_all(agent);
    while (start_.next()) take(start_);
  }

  std::vector<PoseRow> rows;

 private:
  void take(const Statement& row) {
    rows.push_back({row.integer(0), row.integer(1), row.real(2), row.real(3), row.real(4)});
  }

  Statement count_, span_, before_, start_;
};

bool is_full(const Record& record, PoseRows& poses, const Span& span) {
  std::int64_t left = kMostPoses + 1;
  for (const std::int64_t agent : record.agents()) {
    left -= poses.count(agent, span, left);
    if (left == 0) return true;
  }
  return false;
}

}  // namespace

std::string poses_tile(Record& record, const Span& span) {
  PoseRows poses(record);
  const bool summary = is_full(record, poses, span);
  const std::int64_t part = (span.to() - span.from()) / kBins;
  for (const std::int64_t agent : record.agents()) {
    const std::size_t first = poses.rows.size();
    poses.add_before(agent, span.from());
    for (std::int64_t i = 0; summary && i < kBins; ++i) {
      const std::int64_t from = span.from() + i * part;
      poses.add(agent, from, from + part, 1);
    }
    if (!summary) poses.add(agent, span.from(), span.to(), kMostPoses);
    // The first row can have the time of the start pose itself.
    const auto& rows = poses.rows;
    if (rows.size() > first + 1 && rows[first].at == rows[first + 1].at) {
      poses.rows.erase(poses.rows.begin() + static_cast<std::ptrdiff_t>(first));
    }
  }
  std::ranges::sort(poses.rows, {}, [](const PoseRow& row) { return std::tie(row.at, row.agent); });
  Columns columns({"agent", "at", "x", "y", "theta"});
  for (const PoseRow& row : poses.rows) columns.add(row.agent, row.at, row.x, row.y, row.theta);
  return tile_text(record, span, !summary, columns);
}

}  // namespace view::server
