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

  /// What there is to ask for.
  struct Contents {
    std::vector<std::string> kinds;    ///< Of tiles; empty: there is no record.
    std::vector<std::int64_t> agents;  ///< Whose routes and totals there are.
    std::int64_t until = 0;            ///< ns: there is nothing later.
  };
  Contents contents();

 private:
  /// What is known of a record that was read, so that it need not be read again.
  struct Known {
    FrameDensity frames;
    MessageIndex messages;
    LastRows states{"states", "''"};
    LastRows readings{"readings", "channel"};
    LastRows queues{"queues", "''"};
    SeriesStore series;
    LogLines log;
    std::string world;  ///< Of a run that has ended; empty: not asked for yet.
  };

  std::optional<std::string> answer_open(std::string_view path);
  std::string world();
  std::optional<std::string> of_agent(std::string_view kind, std::int64_t agent);
  std::optional<std::string> tile(std::string_view kind, const Span& span);

  std::filesystem::path folder_;
  std::string name_;
  std::mutex mutex_;  ///< Of all that follows.
  std::optional<Record> record_;
  std::optional<sim::scenario::Scenario> scenario_;  ///< None: it cannot be read any more.
  std::vector<std::string> said_;
  Known known_;
};

}  // namespace view::server
