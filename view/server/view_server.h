#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hal/types/result.h"
#include "view/server/control.h"
#include "view/server/view_api.h"

namespace view::server {

/// Serves the page and its data on 127.0.0.1, in threads of its own. Viewers, however many, do not
/// affect a run.
///
///   ViewServer server({.page = find_page("view_page.html"), .runs = open_results(folders)});
///   server.start();
///   fmt::print("view: {}\n", server.address());
class ViewServer {
 public:
  struct Settings {
    std::optional<std::string> page;  ///< None: it was not built; only the API is served.
    std::vector<std::unique_ptr<Run>> runs;
    ViewApi::Mode mode = ViewApi::Mode::kReplay;
    int port = 0;                   ///< 0: any free port.
    RunControl* control = nullptr;  ///< Null: commands are refused; outlives the server.
    const Clock* clock = nullptr;   ///< Null: the run does not go on; outlives the server.
  };

  explicit ViewServer(Settings settings);
  ~ViewServer();  ///< Stops the server.
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// Call once. @return kInvalidArgument if the port is taken; the message names it.
  hal::Result<void> start();

  /// Cuts all connections; a query in progress continues to its end. Does nothing if the server is
  /// not running.
  void stop();

  int port() const;

  /// For the browser of the user who started the server: includes the token that a live run's page
  /// needs.
  std::string address() const;

 private:
  class Http;
  std::unique_ptr<Http> http_;
};

}  // namespace view::server
