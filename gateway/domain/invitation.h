#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gateway/guard/datagram_filter.h"
#include "gateway/process/owned_descriptor.h"
#include "gateway/process/process_watch.h"

namespace gateway::domain {

/// Descriptors for a process in another network namespace, by which it takes part in the exchange
/// of this one. A socket stays in the namespace in which it was made: the process gets two sockets
/// of this namespace's 127.0.0.1, so it needs no connection out of its own namespace and has none.
/// The third descriptor is its end of a channel to the Guest.
///
///   Invited invited = invite(participant.port());
///   … start the process with invited.invitation.descriptors() open, under whatever numbers, and
///     with invited.invitation.variable() in its environment …
///
/// Destroying the object closes this process's copies of the descriptors: keep it until the process
/// has its own.
class Invitation {
 public:
  Invitation(process::OwnedDescriptor metatraffic, process::OwnedDescriptor data,
             process::OwnedDescriptor channel, std::string variable)
      : metatraffic_(std::move(metatraffic)),
        data_(std::move(data)),
        channel_(std::move(channel)),
        variable_(std::move(variable)) {}

  std::vector<int> descriptors() const {
    return {metatraffic_.number(), data_.number(), channel_.number()};
  }
  std::pair<std::string, std::string> variable() const;  ///< Name and value.

 private:
  process::OwnedDescriptor metatraffic_, data_, channel_;
  std::string variable_;
};

/// The invited process, as seen by the inviting one. Keep it while serving that process: its
/// destruction closes the channel, which tells the invited process that the server has ended. One
/// thread.
class Guest {
 public:
  /// @param channel  a socket with SO_PASSCRED.   @param port  UDP port from which the process
  /// sends.
  Guest(process::OwnedDescriptor channel, std::uint16_t port)
      : channel_(std::move(channel)), port_(port) {}

  /// Pid of the process in this pid namespace, if it is the guest that announced `instance` and
  /// sends from the guest's port; else nullopt. The pid comes from the kernel, not from the guest
  /// (unix(7), SCM_CREDENTIALS).
  std::optional<process::ProcessIdentity> identity_of(const std::string& instance,
                                                      const guard::UdpSender& sender);

 private:
  void hear();

  process::OwnedDescriptor channel_;
  std::uint16_t port_;
  std::string instance_;  ///< Empty: it has not announced itself yet.
  process::ProcessIdentity identity_;
};

struct Invited {
  Invitation invitation;
  Guest guest;
};

/// Creates the sockets. The process will accept data only from this one.
/// @param host  UDP port on 127.0.0.1 from which this process sends, that of a SendingSocket.
/// @throws std::runtime_error  no port or no descriptor is left.
Invited invite(std::uint16_t host);

}  // namespace gateway::domain
