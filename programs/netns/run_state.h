#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// A process, identified such that a later one with the same pid is not confused with it.
struct Process {
  pid_t number = 0;
  std::uint64_t started = 0;  ///< Start time, as in /proc/<number>/stat.

  /// @return the present process with this number; started = 0: there is none.
  static Process of(pid_t number);
  bool is_alive() const { return started != 0 && of(number).started == started; }
};

/// The content of the file kStateFile in the results folder of a running simulation: everything
/// that is needed to go inside.
struct RunState {
  struct Agent {
    std::string name;
    /// Numbers of init's file descriptors.
    int users = -1, processes = -1, network = -1, mount = -1, host = -1, ipc = -1;
  };

  Process init;          ///< First process of the run's namespaces, as seen from outside.
  std::string dilation;  ///< Value of BARAKA_DILATION.
  std::string library;   ///< Library to preload.
  std::vector<Agent> agents;

  /// @throws std::runtime_error
  void write(const FileDescriptor& folder) const;
  uid_t user = 0;   ///< Set by read(): owner of the file and of init.
  gid_t group = 0;  ///< Set by read(): group of init.

  /// Reads the file. Its content is trusted no more than `user` is: whoever goes inside becomes
  /// that user first.
  /// @throws std::runtime_error  there is no such file, or it is not a regular file; it belongs to
  /// another user and this one is not root; others may write to it.
  static RunState read(const std::filesystem::path& folder);
};

/// Results folders of this user's running simulations that have agents with a network.
std::vector<std::filesystem::path> running_runs();

}  // namespace programs::netns
