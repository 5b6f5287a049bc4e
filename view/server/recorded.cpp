#include "view/server/recorded.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string_view>

#include "hal/files/config/value.h"
#include "sim/scenario/resolved.h"

namespace view::server {
namespace {

constexpr std::string_view kSection = "record.";
constexpr const char* kPosePeriod = "pose_period";
constexpr double kLongestPosePeriod = 3600;  // s, as in files
constexpr hal::Duration kFinePosePeriod = std::chrono::milliseconds{100};

std::string word(const RecordSettings& settings, const std::string& key) {
  const auto found = settings.words.find(key);
  return found == settings.words.end() ? "none" : found->second;
}

/// Parses a time as it is written in a resolved scenario.
hal::Duration duration_of(const std::string& text) {
  const auto seconds = hal::files::config::parse_value(text, "s", 0, kLongestPosePeriod);
  if (seconds) return hal::from_seconds(*seconds);
  throw std::runtime_error(fmt::format("the record's setting {}{} is wrong: {}", kSection,
                                       kPosePeriod, seconds.error().message));
}

}  // namespace

RecordSettings record_settings(Record& record) {
  RecordSettings settings;
  auto row = record.query("SELECT key, value FROM settings WHERE key LIKE 'record.%'");
  while (row.next()) settings.words[row.text(0).substr(kSection.size())] = row.text(1);
  const auto period = settings.words.find(kPosePeriod);
  if (period != settings.words.end()) settings.pose_period = duration_of(period->second);
  return settings;
}

RecordSettings record_settings(const sim::scenario::Scenario& scenario) {
  RecordSettings settings{.words = {}, .pose_period = scenario.record.pose_period};
  for (const auto& [key, value] : sim::scenario::resolved_values(scenario)) {
    if (key.starts_with(kSection)) settings.words[key.substr(kSection.size())] = value;
  }
  return settings;
}

Json recorded_json(const RecordSettings& settings) {
  std::optional<std::int64_t> period;
  if (settings.pose_period) period = settings.pose_period->count();
  return JsonObject()
      .add("frames", word(settings, "frames"))
      .add("messages", word(settings, "messages"))
      .add("routes", word(settings, "routes"))
      .add("queues", word(settings, "routes"))
      .add("readings", word(settings, "readings"))
      .add("poses_period_ns", period)
      .json();
}

Json missing_json(const RecordSettings& settings) {
  JsonArray missing;
  const auto say = [&](const char* what, const char* line) {
    missing.add(JsonObject().add("what", what).add("line", line).json());
  };
  const std::string frames = word(settings, "frames");
  if (frames == "sample") {
    say("frames beyond the first of each simulated second", "record: {frames: all}");
  } else if (frames != "all") {
    say("single frames", "record: {frames: all}");
  }
  const std::string messages = word(settings, "messages");
  if (messages == "sample") {
    say("messages to several agents beyond the first of each simulated second",
        "record: {messages: all}");
  } else if (messages != "all") {
    say("single messages", "record: {messages: all}");
  }
  if (word(settings, "routes") != "all") say("routes and queues", "record: {routes: all}");
  const std::string readings = word(settings, "readings");
  if (readings == "ranges") {
    say("readings of sensors that measure no ranges, and scans of more than 32 rays",
        "record: {readings: all}");
  } else if (readings != "all") {
    say("readings of sensors", "record: {readings: all}");
  }
  if (settings.pose_period && *settings.pose_period > kFinePosePeriod) {
    say("poses ten times a second", "record: {pose_period: 100 ms}");
  }
  return missing.json();
}

}  // namespace view::server
