#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "view/server/record.h"
#include "view/server/tile.h"

namespace view::server {

/// The lines of run.log by time. The file may be long: only the position of each line is kept.
class LogLines {
 public:
  std::string tile(const Record& record, const Span& span);

 private:
  struct Line {
    std::int64_t at = 0;  ///< ns
    std::int64_t begin = 0, size = 0;
  };

  void read(const Record& record);

  std::vector<Line> lines_;
  std::int64_t read_ = 0;  ///< Bytes, up to the end of a line.
};

}  // namespace view::server
