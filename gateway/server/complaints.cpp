#include <fmt/format.h>

#include "gateway/server/server.h"

namespace gateway::server {
namespace {

std::string addresses_of(const std::vector<hal::AgentId>& agents) {
  std::string text;
  for (const hal::AgentId agent : agents) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", agent.value);
  }
  return text;
}

void complain(const ProcessSummary& process, std::vector<std::string>& lines) {
  const auto add = [&](std::uint64_t count, const std::string& what) {
    if (count == 0) return;
    lines.push_back(fmt::format("dropped from process '{}' (pid {}): {} {}", process.name,
                                process.pid, count, what));
  };
  add(process.foreign_actions, fmt::format("actions for agents it was not granted (addresses {})",
                                           addresses_of(process.foreign_agents)));
  add(process.malformed_actions, "malformed actions");
  add(process.stale_replies, "replies to a Step that is not under way");
  add(process.malformed_replies, "malformed replies");
  if (process.foreign_replies == 0) return;
  lines.push_back(fmt::format(
      "dropped {} replies that participant {} and perhaps others gave for process '{}' (pid {})",
      process.foreign_replies, process.foreign_participant, process.name, process.pid));
}

}  // namespace

std::vector<std::string> complaints(const GatewaySummary& summary) {
  std::vector<std::string> lines;
  for (const ProcessSummary& process : summary.processes) complain(process, lines);
  return lines;
}

}  // namespace gateway::server
