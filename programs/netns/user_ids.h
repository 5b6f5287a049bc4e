#pragma once

#include <sys/types.h>

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// The users and groups that exist inside a run, besides user 0, which is the caller. If the caller
/// is root, these are all that it has, with the same numbers; else those of the caller's lines in
/// /etc/subuid and /etc/subgid, from 1 on, mapped by newuidmap(1). A child process stays outside
/// and maps them from there.
///
///   IdMapper mapper;             // before
///   unshare(CLONE_NEWUSER);
///   const std::string why = mapper.map();
class IdMapper {
 public:
  /// @throws std::runtime_error
  IdMapper();
  ~IdMapper();
  IdMapper(const IdMapper&) = delete;
  IdMapper& operator=(const IdMapper&) = delete;

  /// Maps the users of the calling process. @pre it has just received its own user namespace.
  /// @return why user 0 is the only one, for display; empty: there are others.
  /// @throws std::runtime_error  not even that one can be mapped; with the reason of errno.
  std::string map();

 private:
  FileDescriptor socket_;  ///< Socket to the child.
  pid_t child_ = -1;
  uid_t user_;   ///< User id of the caller, outside.
  gid_t group_;  ///< Group id of the caller, outside.
};

/// A map that gives a user namespace all users, or groups, of this process's namespace.
/// @param file  of this process: /proc/self/uid_map or gid_map. @throws std::runtime_error
std::string identity_map(const char* file);

/// The last group of the gapless sequence 0, 1, 2, … in this process's user namespace.
gid_t last_group();

/// Writes a short file of the kernel in one call. @throws std::runtime_error  with the reason of
/// errno.
void write_file(const std::string& path, const std::string& content, int flags = 0);

}  // namespace programs::netns
