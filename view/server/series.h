#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// Time series of observables and of values that controllers recorded. The record has all of them
/// interleaved in order of time, so those that were requested are cached.
class SeriesStore {
 public:
  /// [{index, name, agent, unit}]; an index does not change while a run goes on.
  static Json list(Record& record);
  static std::vector<std::int64_t> indices(Record& record);

  /// The tile of one series. @return "" if there is no series of that index.
  std::string tile(Record& record, std::int64_t index, const Span& span);

 private:
  struct Series {
    std::vector<std::pair<std::int64_t, double>> samples;  ///< ns and value
    std::int64_t read = 0;                                 ///< rowid
  };

  const Series* find(Record& record, std::int64_t index);

  std::map<std::int64_t, Series> kept_;
  std::size_t samples_ = 0;  ///< Number of all cached samples.
};

}  // namespace view::server
