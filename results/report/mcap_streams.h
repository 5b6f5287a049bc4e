#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "results/record/run_reader.h"
#include "results/report/exported_scene.h"
#include "results/report/mcap_topics.h"

namespace results::report {

/// Rows of a query, sorted by time, to be turned into messages. The first column is the time [ns].
class McapStream {
 public:
  using OnRow = std::function<void(std::int64_t at_ns, const record::Statement& row)>;
  using AtEnd = std::function<void(std::int64_t at_ns)>;

  /// @param on_row  called for each row.
  /// @param at_end  called after the last row of an instant.
  McapStream(record::RunReader& reader, std::string_view sql, OnRow on_row, AtEnd at_end = {});

  bool has_more() const { return has_more_; }
  std::int64_t at_ns() const {
    return rows_.integer(0);
  }                     ///< Time of the next row. @pre has_more()
  void take_instant();  ///< Handles all rows with the time at_ns(). @pre has_more()

 private:
  record::Statement rows_;
  OnRow on_row_;
  AtEnd at_end_;
  bool has_more_;
};

using McapStreams = std::vector<std::unique_ptr<McapStream>>;

/// What the streams read from and write to; must outlive them.
struct McapParts {
  record::RunReader& reader;
  const ExportedScene& scene;
  McapTopics& topics;
  /// Names of agents by address, and "everyone", "neighbours".
  const std::map<std::int64_t, std::string>& names;

  std::string name(std::int64_t agent) const;  ///< "": the address has no name.
};

void add_pose_streams(const McapParts& parts, McapStreams& streams);
void add_movable_stream(const McapParts& parts, McapStreams& streams);
void add_network_streams(const McapParts& parts, McapStreams& streams);
void add_route_stream(const McapParts& parts, McapStreams& streams);
void add_controller_streams(const McapParts& parts, McapStreams& streams);
void add_reading_streams(const McapParts& parts, McapStreams& streams);

/// Publishes the parts of the scene that never change, with the time 0.
void publish_static_transforms(const McapParts& parts);
void publish_walls(const McapParts& parts);

}  // namespace results::report
