#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "results/record/recorder.h"
#include "sim/radio/mac/frame.h"
#include "tests/unit/results/record/test_run.h"
#include "view/server/run.h"

namespace view::server::test {

using namespace std::chrono_literals;
using hal::AgentId;
using hal::Time;
using hal::Verdict;
using nlohmann::json;

inline sim::radio::Frame frame_of(std::uint64_t count, AgentId from, AgentId to) {
  sim::radio::Frame frame;
  frame.id = (std::uint64_t{from.value} << 48) + count;
  frame.transmitter = from;
  frame.receiver = to;
  frame.airtime = 1ms;
  return frame;
}

/// The record of a run of two motes and a robot, written by who writes those of real ones.
class SmallResult {
 public:
  explicit SmallResult(const std::string& name)
      : folder_(name),
        recorder(std::make_unique<results::record::Recorder>(
            folder_.file(), results::record::test::small_config(),
            results::record::RecorderOptions{.pose_period = 100ms,
                                             .frames = sim::scenario::Detail::kAll,
                                             .routes = sim::scenario::Detail::kAll,
                                             .readings = sim::scenario::Detail::kAll})) {
    recorder->set("scenario", "small");
    recorder->set("run_id", "1");
  }

  const std::filesystem::path& path() const { return folder_.path(); }

  void end(std::int64_t at_ns) {
    recorder->set("ended_ns", static_cast<std::uint64_t>(at_ns));
    recorder->set("result", "arrived");
    recorder.reset();
  }

  /// Adds rows by hand to a record that has ended.
  void execute(const std::string& sql) const {
    results::record::Database(folder_.file(), results::record::Database::Mode::kUpdate)
        .execute(sql);
  }

 private:
  results::record::test::Folder folder_;

 public:
  std::unique_ptr<results::record::Recorder> recorder;
};

inline json ask(Run& run, const std::string& path) {
  const std::optional<std::string> answer = run.answer(path);
  return answer ? json::parse(*answer) : json();
}

}  // namespace view::server::test
