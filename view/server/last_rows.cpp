#include "view/server/last_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "view/server/row_times.h"

namespace view::server {
namespace {

using results::record::Statement;

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
    const std::int64_t at = rows.integer(1), part = at >> kBitsOfPart;
    if (at < latest_) rows.refuse(1, kOutOfOrder);
    // Only at the first row of a part: otherwise rows of the same part would count as rows before
    // it.
    if (part > latest_ >> kBitsOfPart && since_ >= last_.size()) {
      kept_.push_back({part, read_, last_});
      since_ = 0;
    }
    latest_ = at;
    read_ = rows.integer(0);
    set(last_, number_of(rows.integer(2), rows.text(3)), read_);
    ++since_;
    any = true;
  }
  return any;
}

std::vector<std::int64_t> LastRows::before(Record& record, std::int64_t at) {
  while (latest_ < at && advance(record)) {
  }
  const auto after = std::ranges::upper_bound(kept_, at >> kBitsOfPart, {}, &Kept::part);
  Last last;
  std::int64_t read = 0;
  if (after != kept_.begin()) {
    last = std::prev(after)->last;
    read = std::prev(after)->read;
  }
  const Rows late = rows_between(record, table_, 0, at);
  Statement rows = record.query(
      fmt::format("SELECT rowid, agent, {} FROM {} WHERE rowid > ? AND rowid < ? ORDER BY rowid",
                  thing_, table_));
  rows.bind_all(read, late.end);
  while (rows.next()) set(last, number_of(rows.integer(1), rows.text(2)), rows.integer(0));
  std::ranges::sort(last);
  last.erase(last.begin(), std::ranges::upper_bound(last, 0));
  return last;
}

}  // namespace view::server
