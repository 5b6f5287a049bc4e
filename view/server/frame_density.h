#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// For equal parts of a time span: the number of frames of each class that began in each part, and
/// the number of receptions, by their intended receivers, that failed.
struct FrameBins {
  std::map<std::string, std::vector<std::int64_t>> counts;  ///< By class.
  std::vector<std::int64_t> lost;
};

/// The same as a sparse list, by number of the part.
struct FrameParts {
  using Counts = std::map<std::int64_t, std::int64_t>;
  std::map<std::string, Counts> counts;  ///< By class.
  Counts lost;
};

/// Counts frames for time spans of any length. Counting all frames of an hour takes seconds, so it
/// is done once, as the record grows, in parts; the bins of coarse tiles are sums of parts. Memory
/// grows with the number of frames, not with their times.
class FrameDensity {
 public:
  /// The bins of a tile. @pre the record has the tables of frames.
  FrameBins bins(Record& record, const Span& span);

  /// Continues to count, for a short while, if the record has more frames. @return whether there
  /// are more.
  bool advance(Record& record);

 private:
  FrameParts parts_;
  std::int64_t counted_ = 0;  ///< ns: all parts that end before or at this time have been counted.
};

}  // namespace view::server
