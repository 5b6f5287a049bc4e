#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "view/server/record.h"

namespace view::server {

/// Finds the last row of each of many things before a given time, in a table of changes: what
/// changes seldom may have changed long ago. The table is read once, as it grows. The state is kept
/// as a checkpoint about once per second of the run, or less often if there are more things than
/// rows in that second, so that memory grows with the size of the table, not with its times.
class LastRows {
 public:
  /// @param table  its rows are in order of at_ns.
  /// @param thing  SQL expression for what changes, besides the agent: "channel"; "''" if each
  /// agent has only one.
  LastRows(std::string table, std::string thing)
      : table_(std::move(table)), thing_(std::move(thing)) {}

  /// rowid of each thing's last row before a time [ns], in order of rowid.
  std::vector<std::int64_t> before(Record& record, std::int64_t at);

  /// Reads on, for a short while, if the record has more rows. @return whether there may be more.
  bool advance(Record& record);

 private:
  using Last = std::vector<std::int64_t>;  ///< Rowid, by number of the thing; 0: none yet.

  std::size_t number_of(std::int64_t agent, std::string thing);

  std::string table_, thing_;
  std::map<std::pair<std::int64_t, std::string>, std::size_t> numbers_;
  /// A checkpoint: the last rows at the begin of a part of about one second.
  struct Kept {
    std::int64_t part = 0;
    std::int64_t read = 0;  ///< Rowid of the last row before that part.
    Last last;
  };

  std::vector<Kept> kept_;  ///< Sorted by part.
  Last last_;
  std::int64_t read_ = 0;    ///< rowid
  std::int64_t latest_ = 0;  ///< ns, time of that row.
  std::size_t since_ = 0;    ///< Rows since the last checkpoint.
};

}  // namespace view::server
