#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// Messages between baraka and the first process of its namespaces (init).
enum class MessageKind : std::uint32_t {
  // to init
  kSetUp,    ///< The agents and their clock; replies: kHolder, kAgent for each agent, kReady.
  kStart,    ///< A program, with its log and the descriptors to keep; reply: kStarted or kRefused.
  kGetCpu,   ///< Reply: kCpu.
  kGetIcmp,  ///< Reply: kIcmp.
  kEnd,      ///< Ends all programs and init; no reply.
  // to baraka
  kHolder,   ///< Process id of init in the holder's namespace.
  kAgent,    ///< Descriptors of an agent: TAP, its counters, its page.
  kReady,    ///< Everything has been made.
  kStarted,  ///< Number of the program, and its process id inside.
  kRefused,  ///< The reason, for display.
  kCpu,      ///< Processor time, ns.
  kIcmp,     ///< icmp_not_sent() of each agent.
  kEnded,    ///< A program has ended; sent on the second socket.
};

struct Message {
  MessageKind kind = MessageKind::kEnd;
  std::string content;  ///< Bytes of a Packer, of any length; long content is sent as a file.
  std::vector<FileDescriptor> descriptors;
};

/// Message of errors when the other end is closed.
inline constexpr const char* kGone = "the namespaces of the run are gone";

/// Sends a message as a whole over a socket of type SOCK_SEQPACKET.
/// @throws std::runtime_error  the other end is gone, or the system refuses.
void send(int socket, MessageKind kind, const std::string& content,
          std::span<const int> descriptors = {});

/// Waits for a message. Nullopt: the other end is gone. @throws std::runtime_error
std::optional<Message> receive(int socket);

}  // namespace programs::netns
