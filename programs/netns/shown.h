#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// The folders of which each agent has its own, empty when the run begins.
inline constexpr std::array kOwnFolders{"/tmp", "/run", "/dev/shm"};

/// What of the host's /tmp, /run and /dev/shm is shown to an agent's programs, under the same name,
/// be that a symbolic link or not. Elsewhere they see the host's files anyway.
class Shown {
 public:
  /// Takes hold of a file or folder. Nothing is shown of what is not there, is none of these
  /// folders' or is one of them itself. @throws std::runtime_error
  void add(const std::filesystem::path& path);
  /// Of a program's file, its folder, if that may be shown.
  void add_folder_of(const std::filesystem::path& file);

  /// Puts all that is not there yet in its place. @pre this process is in the agent's mounts.
  /// @throws std::runtime_error
  void put() const;

 private:
  struct Tree {
    std::filesystem::path path;
    FileDescriptor mount;  ///< Detached.
    bool is_folder;
    dev_t device;
    ino_t number;
  };

  std::vector<Tree> trees_;
};

}  // namespace programs::netns
