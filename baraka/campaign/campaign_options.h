#pragma once

#include <optional>
#include <string>
#include <vector>

namespace baraka::campaign {

/// What the command line of `baraka campaign` says.
struct CampaignOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set, of the campaign file.
  std::string out;                     ///< Empty: results/<name>.
  std::optional<int> jobs;             ///< None: as the file says, else one for each processor.
  bool overwrite = false;              ///< An earlier result of a single run there is removed.
  bool retry_failed = false;           ///< Runs that failed are done again.
  bool status = false;                 ///< Only say how far it is.
  std::string engine = "local";
  bool cancel = false;  ///< Only end what Slurm has of it.
};

}  // namespace baraka::campaign
