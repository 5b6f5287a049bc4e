#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view/server/run.h"

namespace view::server {

/// What the page shows, a text for each address: the same whether it is served, live or not, or
/// inlined in a page. From any thread.
class ViewApi {
 public:
  enum class Mode : std::uint8_t { kReplay, kLive, kScenario };

  /// @param runs  at least one.
  ViewApi(std::vector<std::unique_ptr<Run>> runs, Mode mode, bool can_command);

  /// The JSON of an address that begins with /api/; none: there is nothing of that address.
  /// @throws std::runtime_error  the record is damaged, or gone.
  std::optional<std::string> get(std::string_view path) const;

  Mode mode() const { return mode_; }
  const std::vector<std::unique_ptr<Run>>& runs() const { return runs_; }

 private:
  std::string view() const;

  std::vector<std::unique_ptr<Run>> runs_;
  Mode mode_;
  bool can_command_;
};

/// The results in these folders, as `baraka report` finds them, to be seen side by side.
/// @throws std::runtime_error  one holds none, or one of another version.
std::vector<std::unique_ptr<Run>> open_results(const std::vector<std::filesystem::path>& folders);

}  // namespace view::server
