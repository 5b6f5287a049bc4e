#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace baraka::commands {

/// The command line of `baraka capsule`.
struct CapsuleOptions {
  std::string folder;               ///< Of a result or of a campaign.
  std::string file;                 ///< To write: …tar.zst.
  std::vector<std::string> added;   ///< Files to take along, such as sources of controllers.
  std::int64_t most_rows = 10'000;  ///< Larger tables of the database are left out.
};

/// Packs a study so that others can play it again, and prints what is in it.
/// @return kDone. @throws UsageError  there is no such result, or it cannot be played again.
int capsule(const CapsuleOptions& options);

}  // namespace baraka::commands
