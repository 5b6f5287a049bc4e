#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/domain/invitation.h"
#include "gateway/process/domains.h"
#include "hal/node/exchange/ports.h"

namespace gateway::server {

/// When controllers may come.
enum class Attendance : std::uint8_t {
  kBeforeTheRun,  ///< gather() waits for all of them; none can join later. For a simulator.
  kAnyTime,       ///< attend() connects new ones, and disconnects dead ones. For a robot.
};

struct ServerSettings {
  std::uint64_t run = 0;                          ///< Number of the run, in every Step.
  hal::Duration wait = std::chrono::seconds{30};  ///< For the next controller to come.
  std::optional<hal::Duration> reply_timeout = std::chrono::seconds{10};  ///< None: for ever.
  Attendance attendance = Attendance::kBeforeTheRun;
};

/// Faults of one controller process that the run does not show.
struct ProcessSummary {
  std::string name;
  std::int64_t pid = 0;
  std::vector<std::string> agents;
  std::uint64_t exchanges = 0;
  std::uint64_t foreign_actions = 0;  ///< Dropped: for an agent the process was not granted …
  std::vector<hal::AgentId> foreign_agents;  ///< … these, in order of appearance.
  std::uint64_t malformed_actions = 0;       ///< Dropped: they answer no event of their agent.
  std::uint64_t stale_replies = 0;           ///< Dropped: an old or unknown sequence number.
  std::uint64_t malformed_replies = 0;       ///< Dropped: see gateway/exchange/convert.h.
  std::uint64_t foreign_replies = 0;         ///< Dropped: of another participant …
  std::string foreign_participant;           ///< … such as this one, by its GUID prefix.
};

struct GatewaySummary {
  std::vector<ProcessSummary> processes;  ///< By lowest address of their agents.
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
/// The host keeps ports of this server; their exchanges fail once the server is gone. One thread.
class AgentServer {
 public:
  /// @throws std::runtime_error  if DDS cannot be opened.
  AgentServer(process::DomainHold hold, hal::node::exchange::AgentHost& host,
              const ServerSettings& settings);
  ~AgentServer();
  AgentServer(const AgentServer&) = delete;
  AgentServer& operator=(const AgentServer&) = delete;

  int domain() const;

  /// For a controller in another network namespace, which is to be started with it.
  /// @throws std::runtime_error  no port or no descriptor is left.
  domain::Invitation invite();

  /// Waits until every agent has a controller, refusing processes without a right to one, then
  /// connects them to the host in order of their agents. The agents of a process that dies
  /// meanwhile become free again. Afterwards processes are refused.
  /// @param keep_waiting  asked ten times a second; an error ends the wait (Ctrl-C, a spawned
  ///                      program that ended).
  /// Errors: kTimeout (names the agents without a controller), or that of keep_waiting.
  hal::Result<void> gather(const std::function<hal::Result<void>()>& keep_waiting);

  /// With kAnyTime: answers new processes, connects and disconnects controllers at the host. Never
  /// waits. A dead process is disconnected before its successor is answered.
  /// @param now  of the host's clock, for the log.
  void attend(hal::Time now);

  /// For poll(): one is readable when attend() has something to do. -1 is to be skipped.
  std::vector<int> descriptors() const;

  /// Agents that have no controller now.
  std::vector<hal::AgentId> missing() const;

  GatewaySummary summary() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::server
