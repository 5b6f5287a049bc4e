#pragma once

#include <map>
#include <optional>
#include <string>

#include "hal/types/time.h"
#include "sim/scenario/scenario.h"
#include "view/server/json_text.h"
#include "view/server/record.h"

namespace view::server {

/// What is recorded in the results, according to the scenario.
struct RecordSettings {
  /// Keys of `record:` and their values as in a file: "frames" -> "all".
  std::map<std::string, std::string> words;
  std::optional<hal::Duration> pose_period{};  ///< None: the record does not have it.
};

/// @throws std::runtime_error  the record's pose_period is invalid.
RecordSettings record_settings(Record& record);
RecordSettings record_settings(const sim::scenario::Scenario& scenario);

/// {frames, messages, routes, queues, readings, poses_period_ns}; the last is null if it is not
/// known.
Json recorded_json(const RecordSettings& settings);

/// What the view could show if it were recorded: [{what, line}], the line as in a scenario.
Json missing_json(const RecordSettings& settings);

}  // namespace view::server
