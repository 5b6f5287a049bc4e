#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace baraka::commands {

/// A hint for a missing folder: "; did you mean 'results/ten'?" if a folder beside it has a similar
/// name; otherwise empty.
std::string similar_folder(const std::filesystem::path& given);

/// @throws UsageError if one of the folders does not exist, or holds no result, no campaign and no
///   folders of results.
void require_results(const std::vector<std::string>& folders);

/// @throws UsageError if the folder is neither that of a result nor that of a campaign.
void require_result(const std::string& folder);

}  // namespace baraka::commands
