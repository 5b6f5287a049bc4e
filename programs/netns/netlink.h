#pragma once

#include <linux/netlink.h>

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// An rtnetlink(7) socket of the calling thread's network namespace.
class Netlink {
 public:
  /// @throws std::runtime_error
  Netlink();

  /// Sends a request and waits until it has been carried out.
  /// @param request  with its length; its flags are completed. @param what  name of the request,
  /// for messages.
  /// @throws std::runtime_error  it was refused.
  void ask(nlmsghdr& request, const std::string& what) const;

 private:
  FileDescriptor socket_;
};

}  // namespace programs::netns
