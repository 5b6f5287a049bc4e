#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

#include "view/server/record.h"
#include "view/server/row_times.h"
#include "view/server/tile.h"

namespace view::server {

class FrameDensity;
class MessageIndex;
class LastRows;

/// The answer for a tile: its span, whether it is complete or only a summary, and its rows.
/// @param more  further members besides the columns.
std::string tile_text(const Record& record, const Span& span, bool is_complete,
                      const Columns& columns,
                      std::initializer_list<std::pair<std::string_view, Json>> more = {});

/// Whether such an answer has every row.
bool is_complete(std::string_view tile);

/// Kinds of tiles, besides the series of a run.
inline constexpr std::array<std::string_view, 9> kKinds = {
    "poses", "movables", "frames", "messages", "states", "events", "readings", "queues", "log"};

/// Tiles by kind. If a table was not recorded, the tile has no rows.
std::string poses_tile(Record& record, const Span& span);
std::string frames_tile(Record& record, FrameDensity& density, const Span& span);
std::string messages_tile(Record& record, MessageIndex& index, const Span& span);
std::string states_tile(Record& record, LastRows& last, const Span& span);
std::string events_tile(Record& record, const Span& span);
std::string readings_tile(Record& record, LastRows& last, const Span& span);
std::string queues_tile(Record& record, LastRows& last, const Span& span);

/// All changes of one agent's routing table.
std::string routes_json(Record& record, std::int64_t agent);

/// Counters of one agent over the run.
std::string totals_json(Record& record, std::int64_t agent);

/// The bins of a summary with a single curve, for rows of a table.
Json counts_of(Record& record, const std::string& table, const Rows& rows, const Span& span);

/// Format: {"n":64,"counts":[…]}
Json bins_json(const Counts& counts);

}  // namespace view::server
