#pragma once

#include <optional>
#include <string>
#include <vector>

namespace baraka::campaign {

/// The command line of `baraka campaign`.
struct CampaignOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set, for keys of the campaign file.
  std::string out;                     ///< Empty: results/<name>.
  std::optional<int> jobs;             ///< None: as in the file, otherwise one for each processor.
  bool overwrite = false;              ///< Remove an earlier result of a single run there.
  bool retry_failed = false;           ///< Repeat runs that failed.
  bool status = false;                 ///< Only print the progress.
  std::string engine = "local";
  bool tells_points = true;  ///< Print a line for each point at the end.
  bool cancel = false;       ///< Only end the campaign's Slurm jobs.
};

}  // namespace baraka::campaign
