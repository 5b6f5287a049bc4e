#pragma once

#include <cstddef>
#include <string>

#include "view/server/view_api.h"

namespace view::server {

/// A page that needs no server, and the detail that was left out of it.
struct ExportedPage {
  std::string html;
  /// ns: time spans shorter than this are shown only as summaries where they have many rows; 0:
  /// nothing was left out.
  std::int64_t finest = 0;
};

/// Exports the page with the answers that it would request from a server. For each run these are
/// the world, the totals and routes of its agents and, for each kind, the tiles from the one that
/// holds the whole run down to those that have all rows. Coarse tiles come first, until the limit
/// is reached.
/// @param page  as bundled. @param most  limit for the answers [byte].
/// @throws std::runtime_error  the page has no script in front of which the answers can be put, or
/// even the coarsest answers exceed the limit.
ExportedPage export_page(const ViewApi& api, const std::string& page, std::size_t most);

}  // namespace view::server
