#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace baraka::commands {

/// "; did you mean 'results/ten'?" if a folder beside the one that is not there has nearly its
/// name.
std::string similar_folder(const std::filesystem::path& given);

/// @throws UsageError if one of the folders holds no result and no campaign, nor folders of
/// results,
///   or is no folder.
void require_results(const std::vector<std::string>& folders);

/// @throws UsageError if the folder itself is none of a result or of a campaign.
void require_result(const std::string& folder);

}  // namespace baraka::commands
