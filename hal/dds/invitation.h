#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hal/dds/datagram_filter.h"
#include "hal/dds/owned_descriptor.h"
#include "hal/dds/process_watch.h"

namespace hal::dds {

/// What a process in another network namespace is started with, to take part in the exchange of
/// this one. A socket stays in the namespace that it was made in: the process is handed two of this
/// namespace's 127.0.0.1, and so needs no way out of its own and finds none. The third descriptor
/// is its end of a channel to the Guest.
///
///   Invited invited = invite(participant.port());
///   … start the process with invited.invitation.descriptors() open, under whatever numbers, and
///     with invited.invitation.variable() in its environment …
///
/// The copies of this process close with the object: not before the process has its own.
class Invitation {
 public:
  Invitation(OwnedDescriptor metatraffic, OwnedDescriptor data, OwnedDescriptor channel,
             std::string variable)
      : metatraffic_(std::move(metatraffic)),
        data_(std::move(data)),
        channel_(std::move(channel)),
        variable_(std::move(variable)) {}

  std::vector<int> descriptors() const {
    return {metatraffic_.number(), data_.number(), channel_.number()};
  }
  std::pair<std::string, std::string> variable() const;  ///< Name and value.

 private:
  OwnedDescriptor metatraffic_, data_, channel_;
  std::string variable_;
};

/// Who was invited, as the inviting process sees it. It lives as long as that one serves it: by the
/// end of the channel the invited process learns that the other one is gone. One thread.
class Guest {
 public:
  /// @param channel  of SO_PASSCRED.   @param port  UDP, from which the process speaks.
  Guest(OwnedDescriptor channel, std::uint16_t port) : channel_(std::move(channel)), port_(port) {}

  /// What the process is called in the pid namespace of this one, if it is the guest that has said
  /// to be `instance` and speaks from the guest's port; else none. The kernel tells, not the guest
  /// (unix(7), SCM_CREDENTIALS).
  std::optional<ProcessIdentity> identity_of(const std::string& instance, const UdpSender& sender);

 private:
  void hear();

  OwnedDescriptor channel_;
  std::uint16_t port_;
  std::string instance_;  ///< Empty: it has not been heard.
  ProcessIdentity identity_;
};

struct Invited {
  Invitation invitation;
  Guest guest;
};

/// Makes the sockets. The process will listen to nobody but this one.
/// @param host  UDP port from which this one speaks on 127.0.0.1: of a SendingSocket.
/// @throws std::runtime_error  no port or no descriptor is left.
Invited invite(std::uint16_t host);

}  // namespace hal::dds
