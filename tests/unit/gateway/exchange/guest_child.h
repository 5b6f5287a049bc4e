#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gateway/exchange/server.h"
#include "tests/unit/gateway/exchange/child.h"

/// This test program once more, in network, pid and user namespaces of its own, where there is a
/// loopback interface and nothing else. It ends when its first process, of `unshare`, is killed.
class GuestChild {
 public:
  GuestChild(gateway::exchange::Server& server, std::vector<std::string> role)
      : GuestChild(server.invite(), std::move(role)) {}

  /// Whether this system lets us make such namespaces.
  static bool is_possible() {
    return std::system("unshare -Urn --pid --fork true 2> /dev/null") == 0;  // NOLINT: of a test
  }

  Child& first() { return child_; }

 private:
  GuestChild(const gateway::domain::Invitation& invitation, std::vector<std::string> role)
      : child_(arguments(invitation, std::move(role)), "/usr/bin/unshare",
               invitation.descriptors()) {}

  static std::vector<std::string> arguments(const gateway::domain::Invitation& invitation,
                                            std::vector<std::string> role) {
    const auto [name, value] = invitation.variable();
    const auto self = std::filesystem::read_symlink("/proc/self/exe").string();
    std::vector<std::string> arguments{
        "-Urn", "--pid", "--fork", "--kill-child=SIGKILL", "/usr/bin/env", name + "=" + value,
        self};
    arguments.insert(arguments.end(), role.begin(), role.end());
    return arguments;
  }

  Child child_;
};
