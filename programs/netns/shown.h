#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// The folders that each agent has for itself; they are empty when the run begins.
inline constexpr std::array kOwnFolders{"/tmp", "/run", "/dev/shm"};

/// The files of the host's /tmp, /run and /dev/shm that an agent's programs see, under the same
/// name, even if that is a symbolic link. In all other folders they see the host's files anyway.
class Shown {
 public:
  /// Adds a file or folder. It is ignored if it does not exist, is not in one of these folders, or
  /// is such a folder itself. @throws std::runtime_error
  void add(const std::filesystem::path& path);
  /// Adds the folder of a program's file, if it may be shown.
  void add_folder_of(const std::filesystem::path& file);

  /// Mounts all that is not there yet. @pre this process is in the agent's mount namespace.
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
