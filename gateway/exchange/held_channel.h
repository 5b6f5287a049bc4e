#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/process/owned_descriptor.h"

namespace gateway::exchange {

/// The environment variable with the number of the descriptor that a held controller inherits.
inline constexpr const char* kHeldVariable = "BARAKA_HELD_EXCHANGE";

/// What is exchanged over a HeldChannel, each as DDS would send it.
enum class HeldKind : std::uint32_t { kHello = 1, kSession, kStep, kReply };

struct HeldMessage {
  HeldKind kind{};
  std::vector<std::uint8_t> bytes;
};

/// One end of the exchange with a controller that the run holds in lock-step: a stream socket of
/// this host. The controller is in another network namespace, and its threads go on only when the
/// run lets them, so that DDS, whose threads follow the wall clock, is of no use.
///
///   each message: kind, length (32 bits each, as in memory), so many bytes
///
/// One thread.
class HeldChannel {
 public:
  /// Whether flush() waits until everything is sent.
  enum class Sends : std::uint8_t { kAtOnce, kWaiting };
  /// Longest message [byte].
  static constexpr std::size_t kMost = 1U << 28U;

  HeldChannel(process::OwnedDescriptor socket, Sends sends)
      : socket_(std::move(socket)), sends_(sends) {}

  /// Adds a message to what flush() sends.
  void put(const HeldMessage& message);
  /// Sends what the socket takes. @return whether it has taken anything.
  bool flush();
  /// Receives what there is, without waiting. @return whether there was anything.
  bool receive();
  /// The next message that has arrived as a whole.
  std::optional<HeldMessage> take();

  /// Whether the other end is closed, or has sent what is no message.
  bool is_closed() const { return is_closed_; }
  int descriptor() const { return socket_.number(); }
  /// The process that sent what came last, as numbered here, if the socket has SO_PASSCRED; else 0.
  pid_t peer() const { return peer_; }

 private:
  process::OwnedDescriptor socket_;
  Sends sends_;
  std::vector<std::uint8_t> in_, out_;
  bool is_closed_ = false;
  pid_t peer_ = 0;
};

/// The two ends of a channel: this process's, which learns who sends, and the controller's.
/// @throws std::runtime_error  no descriptor is left.
struct HeldEnds {
  process::OwnedDescriptor own, controllers;
};
HeldEnds make_held_ends();

/// Takes the end that this process has inherited. None: there is none, or it was taken before.
/// Programs that this process starts do not inherit it.
/// @throws std::runtime_error  the environment names a descriptor that is no socket.
std::optional<process::OwnedDescriptor> take_held_end();

}  // namespace gateway::exchange
