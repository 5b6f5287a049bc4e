#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/scenario.h"
#include "view/server/frame_density.h"
#include "view/server/last_rows.h"
#include "view/server/log_lines.h"
#include "view/server/message_index.h"
#include "view/server/record.h"
#include "view/server/series.h"

namespace view::server {

/// Answers the page's requests about one run. From any thread.
class Run {
 public:
  /// The result in a folder. @throws std::runtime_error  it is missing, damaged or of another
  /// version.
  explicit Run(const std::filesystem::path& folder);

  /// A scenario that has not been run: its world at the start.
  /// @param said  messages of `baraka check` about it, one per line.
  Run(const std::filesystem::path& file, sim::scenario::Scenario scenario,
      std::vector<std::string> said);
  ~Run();

  const std::string& name() const { return name_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// The answer for world, coverage, KIND/LEVEL/INDEX, routes/AGENT or totals/AGENT; none if the
  /// path is not valid.
  std::optional<std::string> answer(std::string_view path);

  /// What can be requested.
  struct Contents {
    std::vector<std::string> kinds;    ///< Kinds of tiles; empty: there is no record.
    std::vector<std::int64_t> agents;  ///< Agents with routes and totals.
    std::int64_t until = 0;            ///< ns: there is nothing later.
  };
  Contents contents();

 private:
  /// Indices of a record that has been read, so that it need not be read again.
  struct Known {
    FrameDensity frames;
    MessageIndex messages;
    LastRows states{"states", "''"};
    LastRows readings{"readings", "channel"};
    LastRows queues{"queues", "''"};
    SeriesStore series;
    LogLines log;
    std::string coverage{};  ///< Empty: not requested yet.
    std::string world;       ///< World of a run that has ended; empty: not requested yet.
  };

  std::optional<std::string> answer_open(std::string_view path);
  std::string world();
  std::string coverage();
  std::optional<std::string> of_agent(std::string_view kind, std::int64_t agent);
  std::optional<std::string> tile(std::string_view kind, const Span& span);

  std::filesystem::path folder_;
  std::string name_;
  std::mutex mutex_;  ///< Guards all members below.
  std::optional<Record> record_;
  std::optional<sim::scenario::Scenario> scenario_;  ///< None: it can no longer be read.
  std::vector<std::string> said_;
  Known known_;
};

}  // namespace view::server
