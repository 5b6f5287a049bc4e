#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/domain/invitation.h"
#include "gateway/exchange/held_link.h"
#include "gateway/process/domains.h"
#include "hal/node/exchange/ports.h"

namespace gateway::server {

/// When controllers can join.
enum class Attendance : std::uint8_t {
  kBeforeTheRun,  ///< gather() waits for all; none can join later. For a simulator.
  kAnyTime,       ///< attend() connects new ones, disconnects dead ones. For a robot.
};

struct ServerSettings {
  std::uint64_t run = 0;                          ///< Number of the run, in every Step.
  hal::Duration wait = std::chrono::seconds{30};  ///< For the next controller to join.
  std::optional<hal::Duration> reply_timeout = std::chrono::seconds{10};  ///< None: no limit.
  Attendance attendance = Attendance::kBeforeTheRun;
};

/// Faults of one controller process that are not visible in the run.
struct ProcessSummary {
  std::string name;
  std::int64_t pid = 0;
  std::vector<std::string> agents;
  std::uint64_t exchanges = 0;
  std::uint64_t foreign_actions = 0;  ///< Dropped: for agents that the process was not granted.
  std::vector<hal::AgentId> foreign_agents;  ///< These agents, in order of first occurrence.
  std::uint64_t malformed_actions = 0;       ///< Dropped: they answer no event of their agent.
  std::uint64_t stale_replies = 0;           ///< Dropped: an old or unknown sequence number.
  std::uint64_t malformed_replies = 0;       ///< Dropped: see gateway/exchange/convert.h.
  std::uint64_t foreign_replies = 0;         ///< Dropped: from another participant.
  std::string foreign_participant;           ///< GUID prefix of the first such participant.
};

struct GatewaySummary {
  std::vector<ProcessSummary> processes;  ///< Sorted by the lowest address of their agents.
};

/// One line per kind of dropped data, with its sender; empty if nothing was dropped. Refusals are
/// not included: each was logged as a warning at once.
std::vector<std::string> complaints(const GatewaySummary& summary);

/// Serves the agents of a host to controller processes over DDS.
///
///   AgentServer server(gateway::process::take_domain(std::nullopt), host, {});
///   … start controllers with BARAKA_DOMAIN = server.domain() …
///   server.gather([] { return hal::Result<void>{}; });
///   … run the host: its ports are remote now …
///   for (const std::string& line : complaints(server.summary())) …
///
/// The host keeps ports of this server; their exchanges fail after the server is gone. One thread.
class AgentServer {
 public:
  /// @throws std::runtime_error  if DDS cannot be opened.
  AgentServer(process::DomainHold hold, hal::node::exchange::AgentHost& host,
              const ServerSettings& settings);
  ~AgentServer();
  AgentServer(const AgentServer&) = delete;
  AgentServer& operator=(const AgentServer&) = delete;

  int domain() const;

  /// An invitation for a controller in another network namespace, which is to be started with it.
  /// @throws std::runtime_error  no port or no descriptor is left.
  domain::Invitation invite();

  /// The exchange with a controller in lock-step, which is about to be started. It is over in
  /// gather(), in which the object ends, too, if it is refused.
  /// @throws std::runtime_error  no descriptor is left.
  exchange::HeldLink& expect(exchange::HeldTurns turns);

  /// Waits until every agent has a controller and refuses processes that may not control any, then
  /// connects them to the host in order of their agents. If a process dies meanwhile, its agents
  /// become free again. Afterwards all processes are refused.
  /// @param keep_waiting  called ten times a second; an error ends the wait (Ctrl-C, a spawned
  /// program that ended).
  /// Errors: kTimeout (names the agents without a controller), or that of keep_waiting.
  hal::Result<void> gather(const std::function<hal::Result<void>()>& keep_waiting);

  /// With kAnyTime: answers new processes, connects and disconnects controllers at the host. Never
  /// waits. A dead process is disconnected before its successor is answered.
  /// @param now  time of the host's clock, for the log.
  void attend(hal::Time now);

  /// For poll(): one of them is readable when attend() has something to do. Skip -1.
  std::vector<int> descriptors() const;

  /// Agents that have no controller at this time.
  std::vector<hal::AgentId> missing() const;

  GatewaySummary summary() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::server
