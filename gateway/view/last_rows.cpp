#include "gateway/view/last_rows.h"

#include <fmt/format.h>

#include <algorithm>

#include "gateway/view/row_times.h"

namespace gateway::view {
namespace {

using sim::record::Statement;

constexpr int kBitsOfPart = 30;  // 1.07 s in ns
constexpr std::int64_t kRowsAtATime = 20'000;

void set(std::vector<std::int64_t>& last, std::size_t number, std::int64_t row) {
  if (last.size() <= number) last.resize(number + 1);
  last[number] = row;
}

}  // namespace

std::size_t LastRows::number_of(std::int64_t agent, std::string thing) {
  return numbers_.try_emplace({agent, std::move(thing)}, numbers_.size()).first->second;
}

bool LastRows::advance(Record& record) {
  Statement rows = record.query(
      fmt::format("SELECT rowid, at_ns, agent, {} FROM {} WHERE rowid > ? ORDER BY rowid LIMIT ?",
                  thing_, table_));
  rows.bind_all(read_, kRowsAtATime);
  bool any = false;
  while (rows.next()) {
    const auto part = static_cast<std::size_t>(rows.integer(1) >> kBitsOfPart);
    while (kept_.size() <= part) kept_.push_back(last_);
    read_ = rows.integer(0);
    set(last_, number_of(rows.integer(2), rows.text(3)), read_);
    any = true;
  }
  return any;
}

std::vector<std::int64_t> LastRows::before(Record& record, std::int64_t at) {
  const auto part = static_cast<std::size_t>(at >> kBitsOfPart);
  // One more: what is kept of the part is only then complete.
  while (kept_.size() <= part + 1 && advance(record)) {
  }
  Last last = part < kept_.size() ? kept_[part] : last_;
  if (part < kept_.size()) {
    const std::int64_t begin = static_cast<std::int64_t>(part) << kBitsOfPart;
    const Rows late = rows_between(record, table_, begin, at);
    Statement rows = record.query(
        fmt::format("SELECT rowid, agent, {} FROM {} WHERE rowid >= ? AND rowid < ? ORDER BY rowid",
                    thing_, table_));
    rows.bind_all(late.begin, late.end);
    while (rows.next()) set(last, number_of(rows.integer(1), rows.text(2)), rows.integer(0));
  }
  std::ranges::sort(last);
  last.erase(last.begin(), std::ranges::upper_bound(last, 0));
  return last;
}

}  // namespace gateway::view
