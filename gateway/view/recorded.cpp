#include "gateway/view/recorded.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "sim/scenario/resolved.h"

namespace gateway::view {
namespace {

constexpr std::string_view kSection = "record.";
constexpr double kFinePosePeriod = 0.1;  // s

std::string setting(const RecordSettings& settings, const std::string& key) {
  const auto found = settings.find(std::string(kSection) + key);
  return found == settings.end() ? "none" : found->second;
}

/// "100 ms" or "1 s" in seconds, as resolved scenarios write times.
double seconds_of(std::string_view text) {
  double number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit = text.substr(static_cast<std::size_t>(read.ptr - text.data()));
  const std::string_view names[] = {" s", " ms", " us", " min", " h"};
  const double factors[] = {1, 1e-3, 1e-6, 60, 3600};
  for (std::size_t i = 0; i < std::size(names); ++i) {
    if (unit == names[i]) return number * factors[i];
  }
  return 0;
}

}  // namespace

RecordSettings record_settings(Record& record) {
  RecordSettings settings;
  auto row = record.query("SELECT key, value FROM settings WHERE key LIKE 'record.%'");
  while (row.next()) settings[row.text(0)] = row.text(1);
  return settings;
}

RecordSettings record_settings(const sim::scenario::Scenario& scenario) {
  RecordSettings settings;
  for (const auto& [key, value] : sim::scenario::resolved_values(scenario)) {
    if (key.starts_with(kSection)) settings[key] = value;
  }
  return settings;
}

Json recorded_json(const RecordSettings& settings) {
  const double period = seconds_of(setting(settings, "pose_period"));
  return JsonObject()
      .add("frames", setting(settings, "frames"))
      .add("messages", setting(settings, "messages"))
      .add("routes", setting(settings, "routes"))
      .add("queues", setting(settings, "routes"))
      .add("readings", setting(settings, "readings"))
      .add("poses_period_ns", std::llround(period * 1e9))
      .json();
}

Json missing_json(const RecordSettings& settings) {
  JsonArray missing;
  const auto say = [&](const char* what, const char* line) {
    missing.add(JsonObject().add("what", what).add("line", line).json());
  };
  const std::string frames = setting(settings, "frames");
  if (frames == "sample") {
    say("frames beyond the first of each simulated second", "record: {frames: all}");
  } else if (frames != "all") {
    say("single frames", "record: {frames: all}");
  }
  if (setting(settings, "messages") != "all") say("single messages", "record: {messages: all}");
  if (setting(settings, "routes") != "all") say("routes and queues", "record: {routes: all}");
  const std::string readings = setting(settings, "readings");
  if (readings == "ranges") {
    say("readings of sensors that measure no ranges", "record: {readings: all}");
  } else if (readings != "all") {
    say("readings of sensors", "record: {readings: all}");
  }
  if (seconds_of(setting(settings, "pose_period")) > kFinePosePeriod) {
    say("poses ten times a second", "record: {pose_period: 100 ms}");
  }
  return missing.json();
}

}  // namespace gateway::view
