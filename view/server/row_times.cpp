#include "view/server/row_times.h"

#include <fmt/format.h>

namespace view::server {
namespace {

using results::record::Statement;

constexpr std::int64_t kMostRowids = std::int64_t{1} << 53;

/// The first row of a range whose time is not before `at`; rows.end if there is none.
std::int64_t first_row(Statement& time_of_row, Rows rows, std::int64_t at) {
  while (rows.begin < rows.end) {
    const std::int64_t middle = rows.begin + rows.count() / 2;
    time_of_row.bind_all(middle);
    bool is_before = false;
    while (time_of_row.next()) is_before = time_of_row.integer(0) < at;
    (is_before ? rows.begin : rows.end) = is_before ? middle + 1 : middle;
  }
  return rows.begin;
}

}  // namespace

Rows rows_between(Record& record, const std::string& table, std::int64_t from, std::int64_t to) {
  Statement last =
      record.query(fmt::format("SELECT rowid FROM {} ORDER BY rowid DESC LIMIT 1", table));
  Rows all{1, 1};
  if (last.next()) {
    if (last.integer(0) > kMostRowids) last.refuse(0, "a number that no table comes to");
    all.end = last.integer(0) + 1;
  }
  Statement time_of_row = record.query(fmt::format("SELECT at_ns FROM {} WHERE rowid = ?", table));
  const std::int64_t first = first_row(time_of_row, all, from);
  return {first, first_row(time_of_row, {first, all.end}, to)};
}

}  // namespace view::server
