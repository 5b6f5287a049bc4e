#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal/types/result.h"
#include "view/server/control.h"
#include "view/server/view_api.h"

namespace view::server {

/// Serves the page and what it shows on 127.0.0.1, on threads of its own; whoever looks, and how
/// many, changes nothing of a run.
///
///   ViewServer server({.page = find_page("view_page.html"), .runs = open_results(folders)});
///   server.start();
///   fmt::print("view: {}\n", server.address());
class ViewServer {
 public:
  struct Settings {
    std::optional<std::string> page;  ///< None: it was not built; only the API is there.
    std::vector<std::unique_ptr<Run>> runs;
    ViewApi::Mode mode = ViewApi::Mode::kReplay;
    int port = 0;                   ///< 0: a free one.
    RunControl* control = nullptr;  ///< Null: nothing can be commanded. Outlives the server.
    const Clock* clock = nullptr;   ///< Null: nothing goes on. Outlives the server.
  };

  explicit ViewServer(Settings settings);
  ~ViewServer();  ///< Stops it.
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Once. @return kInvalidArgument: the port is taken, as a message of its own says.
  hal::Result<void> start();

  /// Cuts all connections; a look-up under way goes on to its end. Nothing if it does not run.
  void stop();

  int port() const;

  /// For the browser of whoever started it: with the token that a live run's page needs.
  std::string address() const;

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace view::server
