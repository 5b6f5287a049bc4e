#pragma once

#include <linux/netlink.h>

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// rtnetlink(7) of the network namespace that the calling thread is in.
class Netlink {
 public:
  /// @throws std::runtime_error
  Netlink();

  /// Sends a request and waits until it has been done. @param request  with its length; its flags
  /// are completed. @param what  it is, for people. @throws std::runtime_error  it was refused.
  void ask(nlmsghdr& request, const std::string& what) const;

 private:
  FileDescriptor socket_;
};

}  // namespace programs::netns
