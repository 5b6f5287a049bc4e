#pragma once

#include <optional>
#include <string>
#include <vector>

namespace baraka::commands {

/// The command line of `baraka view`.
struct ViewOptions {
  std::vector<std::string> what;  ///< Folders of results, or one scenario file.
  int port = 0;                   ///< 0: any free port.
  bool open = true;               ///< Open a browser, if there is a desktop.
  std::string file;               ///< Page to write; empty: serve.
  int most_mb = 64;               ///< Most data in that page, MB.
};

/// Serves the view until interrupted, or writes it to a file.
/// @return exit status. @throws std::exception  if something cannot be read, written or served.
int show_view(const ViewOptions& options);

}  // namespace baraka::commands
