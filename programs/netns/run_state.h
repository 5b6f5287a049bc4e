#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// A process that no later one of the same number is taken for.
struct Process {
  pid_t number = 0;
  std::uint64_t started = 0;  ///< As /proc/<number>/stat tells it.

  /// @return the one of this number now; started = 0: there is none.
  static Process of(pid_t number);
  bool is_alive() const { return started != 0 && of(number).started == started; }
};

/// What the file kStateFile in the results folder tells of a run that is under way: all that it
/// takes to go inside.
struct RunState {
  struct Agent {
    std::string name;
    /// Descriptors of init.
    int users = -1, processes = -1, network = -1, mount = -1, host = -1, ipc = -1;
  };

  Process init;          ///< The first process of the run's namespaces, as seen from outside.
  std::string dilation;  ///< BARAKA_DILATION.
  std::string library;   ///< To preload.
  std::vector<Agent> agents;

  /// @throws std::runtime_error
  void write(const FileDescriptor& folder) const;
  uid_t user = 0;   ///< Who runs it, as read(): owns both the file and init.
  gid_t group = 0;  ///< Of init, as read().

  /// What it says is trusted only as far as `user` is: whoever goes inside is that user first.
  /// @throws std::runtime_error  there is no such file, or it is none; it is another user's and
  ///   this one is not root; others may write to it.
  static RunState read(const std::filesystem::path& folder);
};

/// Results folders of the runs of this user that have agents with a network and are under way.
std::vector<std::filesystem::path> running_runs();

}  // namespace programs::netns
