#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view/server/run.h"

namespace view::server {

/// What the page shows, as one text per address. It is the same whether the page is served, live or
/// not, or has the answers inlined. From any thread.
class ViewApi {
 public:
  enum class Mode : std::uint8_t { kReplay, kLive, kScenario };

  /// @param runs  at least one.
  ViewApi(std::vector<std::unique_ptr<Run>> runs, Mode mode, bool can_command);

  /// The JSON for an address that begins with /api/; none if the address is not valid.
  /// @throws std::runtime_error  the record is damaged, or was removed.
  std::optional<std::string> get(std::string_view path) const;

  Mode mode() const { return mode_; }
  const std::vector<std::unique_ptr<Run>>& runs() const { return runs_; }

 private:
  std::string view() const;

  std::vector<std::unique_ptr<Run>> runs_;
  Mode mode_;
  bool can_command_;
};

/// Opens the results in these folders, which are found as by `baraka report`, to be shown side by
/// side.
/// @throws std::runtime_error  a folder has no result, or one of another version.
std::vector<std::unique_ptr<Run>> open_results(const std::vector<std::filesystem::path>& folders);

}  // namespace view::server
