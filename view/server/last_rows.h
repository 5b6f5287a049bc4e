#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "view/server/record.h"

namespace view::server {

/// Finds the last row of each of many things before any time, in a table of changes: one that
/// changes seldom may have changed long ago. The table is read once, as far as it goes, and what
/// was the last is kept for once a second, or more seldom where there are more things than rows in
/// it: what is kept grows with the table, whatever its times are.
class LastRows {
 public:
  /// @param table  its rows are in order of at_ns. @param thing  SQL of the text of what changes,
  ///   beside the agent: "channel"; "''" if there is one of each agent.
  LastRows(std::string table, std::string thing)
      : table_(std::move(table)), thing_(std::move(thing)) {}

  /// rowid of each thing's last row before a time [ns], in order of the rows.
  std::vector<std::int64_t> before(Record& record, std::int64_t at);

  /// Reads on for a short while, if the record has more. @return whether there is more to read
  bool advance(Record& record);

 private:
  using Last = std::vector<std::int64_t>;  ///< rowid, by number of the thing; 0: none yet.

  std::size_t number_of(std::int64_t agent, std::string thing);

  std::string table_, thing_;
  std::map<std::pair<std::int64_t, std::string>, std::size_t> numbers_;
  /// What was the last when a part of time of a second or so began.
  struct Kept {
    std::int64_t part = 0;
    std::int64_t read = 0;  ///< rowid: of the last row before.
    Last last;
  };

  std::vector<Kept> kept_;  ///< By part.
  Last last_;
  std::int64_t read_ = 0;    ///< rowid
  std::int64_t latest_ = 0;  ///< ns, of that row
  std::size_t since_ = 0;    ///< Rows since something was kept.
};

}  // namespace view::server
