#pragma once

#include <sys/types.h>

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// Which users and groups exist inside a run, beside user 0, who is the caller: as root all that
/// the caller has, under the same numbers; else those of the caller's lines in /etc/subuid and
/// /etc/subgid, from 1 on, by newuidmap(1). A child stays outside and maps them from there.
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

  /// Maps the users of the calling process. @pre it has just got a user namespace of its own.
  /// @return why user 0 is the only one, for people; empty: there are others.
  /// @throws std::runtime_error  not even that one can be mapped; errno says why.
  std::string map();

 private:
  FileDescriptor socket_;  ///< To the child.
  pid_t child_ = -1;
  uid_t user_;   ///< Of the caller, outside.
  gid_t group_;  ///< The same.
};

/// The map by which a user namespace has all users, or groups, of the one of this process.
/// @param file  of this process: /proc/self/uid_map or gid_map. @throws std::runtime_error
std::string identity_map(const char* file);

/// The last of the groups 0, 1, 2, … of this process's user namespace, none left out.
gid_t last_group();

/// Writes a short file of the kernel, all at once. @throws std::runtime_error  errno says why.
void write_file(const std::string& path, const std::string& content, int flags = 0);

}  // namespace programs::netns
