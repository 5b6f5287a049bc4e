#pragma once

#include <cstddef>
#include <string>

#include "view/server/view_api.h"

namespace view::server {

/// A page that needs no server, and what was left out of it.
struct ExportedPage {
  std::string html;
  /// ns: spans below this length are shown as summaries where there is much in them; 0: all is
  /// there.
  std::int64_t finest = 0;
};

/// The page with the answers that it would ask for: of each run the world, the totals and routes of
/// its agents and, kind by kind, the tiles from the one that holds the whole run down to those that
/// have all rows; coarse ones first, as far as there is room.
/// @param page  as bundled. @param most  bytes of answers.
/// @throws std::runtime_error  the page has no script before which they could stand, or not even
///   the coarsest answers have room.
ExportedPage export_page(const ViewApi& api, const std::string& page, std::size_t most);

}  // namespace view::server
