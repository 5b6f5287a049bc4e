#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gateway/view/record.h"
#include "sim/scenario/scenario.h"

namespace gateway::view {

/// One run as the page asks for it. From any thread.
class Run {
 public:
  /// The result in a folder. @throws std::runtime_error  it is missing, damaged or of another
  /// version.
  explicit Run(const std::filesystem::path& folder);

  /// A scenario that nobody has run: its world as it will start.
  /// @param said  of it by `baraka check`, a line each.
  Run(const std::filesystem::path& file, sim::scenario::Scenario scenario,
      std::vector<std::string> said);
  ~Run();

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// What is at world, KIND/LEVEL/INDEX, routes/AGENT or totals/AGENT; none: nothing.
  std::optional<std::string> answer(std::string_view path);

 private:
  std::optional<std::string> answer_open(std::string_view path);

  std::filesystem::path folder_;
  std::string name_;
  std::mutex mutex_;  ///< Of all that follows.
  std::optional<Record> record_;
  std::optional<sim::scenario::Scenario> scenario_;  ///< None: it cannot be read any more.
  std::vector<std::string> said_;
};

}  // namespace gateway::view
