#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gateway/domain/invitation.h"
#include "gateway/exchange/process_link.h"
#include "gateway/process/domains.h"
#include "hal/node/exchange/session.h"
#include "hal/types/time.h"

namespace gateway::exchange {

/// The DDS end of a server of agents: receives Hellos, answers them, and makes links to processes.
/// gateway/server/admission.h decides which process gets which agent. One thread at a time.
///
///   Server server(take_domain(std::nullopt));
///   for (const hal::node::exchange::Hello& hello : server.hellos(timeout)) {
///     auto link = server.link(hello, run, reply_timeout);
///     server.answer(session);
///   }
class Server {
 public:
  /// @throws std::runtime_error  if DDS cannot be opened.
  explicit Server(process::DomainHold hold);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int domain() const;
  const std::string& name() const;  ///< Unique for each start; the key of Steps and Replies.

  /// Hellos that have arrived since the last call; waits for the first one, up to `timeout`.
  /// @param watched  further descriptors that end the wait when they become readable; -1 is
  /// skipped.
  std::vector<hal::node::exchange::Hello> hellos(hal::Duration timeout,
                                                 const std::vector<int>& watched = {});
  /// Hellos since the last call that hellos() left out because their claims are false, or because a
  /// port now belongs to another user: "process 'x' (pid 7): reason". Their participants are
  /// refused from then on.
  std::vector<std::string> take_refusals();

  /// Creates an invitation for a process in another network namespace that is about to be started.
  /// Its Hellos have its identity in the pid namespace of this process, whatever it is in its own.
  /// @throws std::runtime_error  no port or no descriptor is left.
  domain::Invitation invite();
  int descriptor() const;   ///< Readable when Hellos may have arrived.
  bool has_hellos() const;  ///< Does not wait; cheap.

  /// Sends a Session or a refusal. `server` is filled in.
  /// Errors: kNotConnected (DDS refuses the sample).
  hal::Result<void> answer(hal::node::exchange::Session session);

  /// Creates the link to an admitted process, one of hellos(). Call it before the Session is sent.
  /// Only Replies of the participant that sent the Hello are accepted.
  /// @param reply_timeout  for every exchange; none: no limit.
  /// @throws std::runtime_error  if DDS cannot create the topics.
  std::unique_ptr<ProcessLink> link(const hal::node::exchange::Hello& hello, std::uint64_t run,
                                    std::optional<hal::Duration> reply_timeout);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace gateway::exchange
