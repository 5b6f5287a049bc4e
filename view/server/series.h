#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// What was recorded over time, of observables and by controllers: lists of times and values. The
/// record has them all in one row of time, so those that somebody looks at are kept.
class SeriesStore {
 public:
  /// [{index, name, agent, unit}]; an index stays as it is while a run goes on.
  static Json list(Record& record);
  static std::vector<std::int64_t> indices(Record& record);

  /// The tile of one. @return "" if there is none of that index.
  std::string tile(Record& record, std::int64_t index, const Span& span);

 private:
  struct Series {
    std::vector<std::pair<std::int64_t, double>> samples;  ///< ns and value
    std::int64_t read = 0;                                 ///< rowid
  };

  const Series* find(Record& record, std::int64_t index);

  std::map<std::int64_t, Series> kept_;
  std::size_t samples_ = 0;  ///< Of all of them.
};

}  // namespace view::server
