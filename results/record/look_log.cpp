#include "results/record/look_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

namespace results::record {

LookLog::LookLog(Database& database, Settings settings)
    : insert_reading_(database, "INSERT INTO readings VALUES (?, ?, ?, ?)"),
      insert_queue_(database, "INSERT INTO queues VALUES (?, ?, ?)"),
      insert_contact_(database, "INSERT INTO contacts VALUES (?, ?, ?)"),
      settings_(settings) {}

bool LookLog::observes(const hal::Channel& channel) const {
  if (settings_.readings == sim::scenario::Detail::kAll) return true;
  if (settings_.readings == sim::scenario::Detail::kNone || channel.length > kFewValues)
    return false;
  constexpr std::string_view kQuiet[] = {"range", "sonar", "scan", "bumper"};
  return std::ranges::find(kQuiet, channel.kind) != std::end(kQuiet);
}

LookLog::Agent& LookLog::agent(hal::AgentId id) {
  if (id.value >= agents_.size()) agents_.resize(id.value + 1u);
  return agents_[id.value];
}

int LookLog::note_touch(hal::Time at, hal::AgentId id, bool touches, bool& before,
                        const char* other) {
  if (std::exchange(before, touches) || !touches) return 0;
  insert_contact_.run(id.value, hal::to_ns(at), other);
  return 1;
}

int LookLog::on_queue(hal::Time at, hal::AgentId id) {
  if (!settings_.queues || !eyes_.queue) return 0;
  const std::uint64_t queue = eyes_.queue(id);
  if (std::exchange(agent(id).queue, queue) == queue) return 0;
  insert_queue_.run(id.value, hal::to_ns(at), queue);
  return 1;
}

int LookLog::on_body(hal::Time at, hal::AgentId id) {
  if (!eyes_.contacts) return 0;
  Agent& seen = agent(id);
  int rows = 0;
  const sim::agents::ContactCounts now = eyes_.contacts(id);
  const sim::agents::ContactCounts then = std::exchange(seen.contacts, now);
  rows += note_touch(at, id, now.wall_steps > then.wall_steps, seen.touches_wall, "wall");
  rows += note_touch(at, id, now.object_steps > then.object_steps, seen.touches_body, "body");
  return rows;
}

int LookLog::on_reading(hal::Time at, hal::AgentId id, const hal::Channel& channel,
                        std::span<const double> values) {
  if (!observes(channel)) return 0;
  Agent& seen = agent(id);
  if (channel.id >= seen.channels.size()) seen.channels.resize(channel.id + 1u);
  Sensed& sensed = seen.channels[channel.id];
  if (at < sensed.next_row) return 0;
  sensed.next_row = hal::Time{(at.time_since_epoch() / settings_.period + 1) * settings_.period};
  fmt::memory_buffer text;
  for (const double value : values) {
    if (text.size() > 0) text.push_back(' ');
    if (std::isnan(value)) {
      text.push_back('-');
    } else {
      fmt::format_to(std::back_inserter(text), "{:.6g}", value);
    }
  }
  const std::string_view reading(text.data(), text.size());
  if (reading == sensed.written) return 0;
  sensed.written = reading;
  insert_reading_.run(id.value, hal::to_ns(at), channel.name, reading);
  return 1;
}

}  // namespace results::record
