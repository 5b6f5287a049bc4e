#include "results/record/look_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include "hal/node/devices/sensors.h"
#include "hal/types/check.h"
#include "sim/agents/quantities.h"
#include "sim/radio/mac/frame.h"

namespace results::record {

LookLog::LookLog(Database& database, Settings settings, Commits& commits)
    : insert_reading_(database, "INSERT INTO readings VALUES (?, ?, ?, ?)"),
      insert_queue_(database, "INSERT INTO queues VALUES (?, ?, ?)"),
      settings_(settings),
      commits_(commits) {}

void LookLog::look_at(const sim::agents::Simulation& simulation) {
  const auto& all = sim::agents::quantities();
  const auto queue = std::ranges::find_if(
      all, [](const auto& one) { return one.domain == "radio" && one.name == "queue"; });
  BARAKA_CHECK(queue != all.end());
  look_at([&simulation, &queue = *queue](hal::AgentId agent) {
    return static_cast<std::uint64_t>(simulation.read(queue, agent).value_or(0));
  });
}

bool LookLog::observes(hal::AgentId, const hal::Channel& channel) const {
  if (settings_.readings == sim::scenario::Detail::kAll) return true;
  if (settings_.readings == sim::scenario::Detail::kNone || channel.length > kFewValues)
    return false;
  return channel.kind == "range" || hal::node::devices::is_quiet(channel.kind);
}

LookLog::Agent& LookLog::agent(hal::AgentId id) {
  if (id.value >= agents_.size()) agents_.resize(id.value + 1u);
  return agents_[id.value];
}

void LookLog::on_frame_start(hal::Time at, const sim::radio::Frame& frame) {
  look_at_queue(at, frame.transmitter);
}

void LookLog::on_request_end(hal::Time at, hal::AgentId sender, hal::AgentId, hal::Verdict) {
  look_at_queue(at, sender);
}

void LookLog::look_at_queue(hal::Time at, hal::AgentId id) {
  if (!settings_.queues || !queue_) return;
  const std::uint64_t queue = queue_(id);
  if (std::exchange(agent(id).queue, queue) == queue) return;
  insert_queue_.run(id.value, hal::to_ns(at), queue);
  commits_.on_rows(at, 1);
}

void LookLog::on_reading(hal::Time at, hal::AgentId id, const hal::Channel& channel,
                         std::span<const double> values) {
  if (!observes(id, channel)) return;
  Agent& seen = agent(id);
  if (channel.id >= seen.channels.size()) seen.channels.resize(channel.id + 1u);
  Sensed& sensed = seen.channels[channel.id];
  if (at < sensed.next_row) return;
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
  if (reading == sensed.written) return;
  sensed.written = reading;
  insert_reading_.run(id.value, hal::to_ns(at), channel.name, reading);
  commits_.on_rows(at, 1);
}

std::vector<Table> LookLog::tables() {
  return {
      {"readings",
       "readings of sensors, with record: {readings: ranges | all}: at most one row per "
       "pose_period and channel, and only if the reading has changed",
       {{"agent", "INTEGER NOT NULL", "", "whose"},
        {"at_ns", "INTEGER NOT NULL", "ns", "control instant"},
        {"channel", "TEXT NOT NULL", "", "name: 'infrared', 'odometry', ..."},
        {"reading", "TEXT NOT NULL", "",
         "its values, with a space between, six digits; - for none (nothing within reach)"}}},
      {"queues",
       "number of frames queued at an agent's radio: a row for each change, seen when the radio "
       "begins to send a frame and when it has finished one; recorded under the same condition as "
       "routes",
       {{"agent", "INTEGER NOT NULL", "", "whose"},
        {"at_ns", "INTEGER NOT NULL", "ns", "when"},
        {"frames", "INTEGER NOT NULL", "", "waiting or being sent"}}},
  };
}

}  // namespace results::record
