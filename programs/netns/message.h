#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// What baraka and the first process of its namespaces tell each other.
enum class MessageKind : std::uint32_t {
  // to init
  kSetUp,    ///< The agents and their clock. Answered by kHolder, kAgent for each, kReady.
  kStart,    ///< A program; with its log and what it keeps. Answered by kStarted or kRefused.
  kGetCpu,   ///< Answered by kCpu.
  kGetIcmp,  ///< Answered by kIcmp.
  kEnd,      ///< Ends all programs and init. Not answered.
  // to baraka
  kHolder,   ///< Process number of init, as the holder sees it.
  kAgent,    ///< Descriptors of an agent: TAP, its counters, its page.
  kReady,    ///< All is made.
  kStarted,  ///< Number of the program.
  kRefused,  ///< Why, for people.
  kCpu,      ///< ns.
  kIcmp,     ///< Of each agent, icmp_not_sent().
  kEnded,    ///< A program, on the second socket.
};

struct Message {
  MessageKind kind = MessageKind::kEnd;
  std::string content;  ///< Of a Packer. Any length: what is long travels as a file.
  std::vector<FileDescriptor> descriptors;
};

/// What those say who find the other end closed.
inline constexpr const char* kGone = "the namespaces of the run are gone";

/// Sends one, whole, over a socket of kind SOCK_SEQPACKET.
/// @throws std::runtime_error  the other end is gone, or the system refuses.
void send(int socket, MessageKind kind, const std::string& content,
          std::span<const int> descriptors = {});

/// Waits for one. Nothing: the other end is gone. @throws std::runtime_error
std::optional<Message> receive(int socket);

}  // namespace programs::netns
