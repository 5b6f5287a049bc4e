#include "results/record/agent_use_log.h"

#include <optional>

#include "sim/radio/mac/frame.h"

namespace results::record {

AgentUseLog::AgentUseLog(Database& database, bool counts_frames)
    : insert_(database, "INSERT INTO agent_use VALUES (?, ?, ?, ?, ?, ?, ?, ?)"),
      counts_frames_(counts_frames) {}

void AgentUseLog::on_frame_start(hal::Time, const sim::radio::Frame& frame) {
  if (!frame.retry) return;
  const std::size_t transmitter = frame.transmitter.value;
  if (transmitter >= retries_.size()) retries_.resize(transmitter + 1);
  ++retries_[transmitter];
}

void AgentUseLog::add(hal::AgentId agent, const sim::agents::AgentUse& use) {
  std::optional<std::uint64_t> retries;
  if (counts_frames_) retries = agent.value < retries_.size() ? retries_[agent.value] : 0;
  insert_.run(agent.value, use.radio.transmitting.count(), use.radio.receiving.count(),
              use.radio.listening.count(), use.radio.off.count(), retries, use.energy, use.load);
}

std::vector<Table> AgentUseLog::tables() {
  return {
      {"agent_use",
       "use of radio and battery, written at the end of the run",
       {{"agent", "INTEGER PRIMARY KEY", "", "who"},
        {"transmitting_ns", "INTEGER NOT NULL", "ns", "time in which its radio transmitted"},
        {"receiving_ns", "INTEGER NOT NULL", "ns",
         "time in which its radio found the medium busy because of others; 0 with profiles without "
         "a MAC"},
        {"listening_ns", "INTEGER NOT NULL", "ns", "time in which its radio found the medium idle"},
        {"off_ns", "INTEGER NOT NULL", "ns", "time in which its radio was off"},
        {"retries", "INTEGER", "", "retransmissions; null with record: {frames: none}"},
        {"energy_j", "REAL", "J",
         "energy drawn from its battery by computer, radio and motors, including losses in the "
         "battery; never more than it contained; null: it has no battery"},
        {"load_j", "REAL", "J",
         "energy that computer, radio and motors demanded, even while the battery was empty; null: "
         "it has no battery"}}},
  };
}

}  // namespace results::record
