#pragma once

#include <map>
#include <optional>
#include <string>

#include "gateway/view/json_text.h"
#include "gateway/view/record.h"
#include "sim/scenario/scenario.h"

namespace gateway::view {

/// Keys of a resolved scenario that tell what goes into the results: "record.frames" -> "all".
using RecordSettings = std::map<std::string, std::string>;

RecordSettings record_settings(Record& record);
RecordSettings record_settings(const sim::scenario::Scenario& scenario);

/// {frames, messages, routes, queues, readings, poses_period_ns}.
Json recorded_json(const RecordSettings& settings);

/// What the view could show if it were recorded: [{what, line}], the line as in a scenario.
Json missing_json(const RecordSettings& settings);

}  // namespace gateway::view
