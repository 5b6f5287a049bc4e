#pragma once

#include <functional>
#include <memory>
#include <string>
#include <variant>

#include "hal/node/exchange/session.h"
#include "hal/node/exchange/step.h"
#include "hal/types/result.h"
#include "hal/types/time.h"

namespace gateway::exchange {

/// A server has left the domain, or its process died.
struct ServerGone {
  std::string server;
};
/// Nothing arrived before the timeout.
struct Silence {};
/// The function that answers Steps asked to wake up next().
struct Woken {};
/// Client::interrupt() was called.
struct Interrupted {};

using Arrival = std::variant<hal::node::exchange::Session, hal::node::exchange::Step, ServerGone,
                             Silence, Woken, Interrupted>;

class ClientEnd;

/// The controller process's end of the exchange: sends Hello to every server of a DDS domain,
/// receives Sessions and Steps, sends Replies. ControllerProcess interprets them. A process that
/// the run holds in lock-step exchanges over a HeldChannel in place of DDS. One thread at a time,
/// except for interrupt() and for calls by an Answerer.
class Client {
 public:
  /// Completes `hello` with the identity of this process and an instance id, and sends it. If the
  /// process was started with an Invitation, it is sent over the sockets of that, to the process
  /// that made it.
  /// @throws std::runtime_error  if DDS, or the channel, cannot be opened.
  Client(int domain, hal::node::exchange::Hello hello);
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  const hal::node::exchange::Hello& hello() const;
  /// Servers that have been discovered, whether they have answered or not.
  int servers() const;

  /// Waits for the next arrival. After a Session that grants agents, Steps of that server and run
  /// follow; other Steps are dropped. Sessions come before Steps.
  /// @param timeout  Duration::max(): no limit.
  Arrival next(hal::Duration timeout);

  /// Answers a Step on the thread that received it, which saves a thread switch: measured 10 to 20
  /// us per exchange. May call reply(). @returns whether next() is to return Woken.
  using Answerer = std::function<bool(const hal::node::exchange::Step&)>;

  /// From now on the Steps of a server that has granted agents go to `answerer` and no longer to
  /// next(); those that have arrived before go there at once, on this thread. Calls of all
  /// answerers of a client exclude each other, and none is in progress when this returns.
  /// @param answerer  empty: Steps go to next() again.
  void answer(const std::string& server, Answerer answerer);

  /// Sends a Reply. @param server, reply.run, reply.sequence  as in the Step; reply.process is
  /// ignored. Errors: kNotConnected (DDS refuses the sample).
  hal::Result<void> reply(const std::string& server, const hal::node::exchange::Reply& reply);

  /// Withdraws the Hello: servers that start from now on do not see it. For a process that is about
  /// to end, so that no server grants it agents in the meantime.
  void withdraw();

  /// Waits until every server has the last Reply, up to `timeout`.
  void flush(hal::Duration timeout);

  /// Makes next() return Interrupted, now and in every later call. Any thread, also from a signal
  /// handler.
  void interrupt() noexcept;

 private:
  std::unique_ptr<ClientEnd> end_;
};

}  // namespace gateway::exchange
