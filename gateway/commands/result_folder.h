#pragma once

#include <string>
#include <vector>

namespace gateway {

/// @throws UsageError if one of the folders holds no result and no campaign, nor folders of
/// results,
///   or is no folder.
void require_results(const std::vector<std::string>& folders);

/// @throws UsageError if the folder itself is none of a result or of a campaign.
void require_result(const std::string& folder);

}  // namespace gateway
