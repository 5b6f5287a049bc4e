#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// How many frames of each class began in each of equal parts of time, and how many receptions of
/// them by whom they were for ended otherwise than delivered.
struct FrameBins {
  std::map<std::string, std::vector<std::int64_t>> counts;  ///< By class.
  std::vector<std::int64_t> lost;
};

/// The same where some began, by number of the part.
struct FrameParts {
  using Counts = std::map<std::int64_t, std::int64_t>;
  std::map<std::string, Counts> counts;  ///< By class.
  Counts lost;
};

/// The same for spans of any length: to count all frames of an hour takes seconds, so it is done
/// once, as far as the record goes, and in parts of which coarse tiles are sums. What is kept grows
/// with the frames, whatever their times are.
class FrameDensity {
 public:
  /// Bins of a tile. @pre record has the tables
  FrameBins bins(Record& record, const Span& span);

  /// Counts on, for a short while, if the record has more. @return whether there is more to count
  bool advance(Record& record);

 private:
  FrameParts parts_;
  std::int64_t counted_ = 0;  ///< ns: parts before are counted, to their end.
};

}  // namespace view::server
