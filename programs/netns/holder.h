#pragma once

#include <sys/types.h>

#include <filesystem>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// The process baraka-holder, and the two sockets to the first process of the namespaces.
class Holder {
 public:
  /// Starts the process. @param folder  its working folder, by which running_runs() finds the run.
  /// @throws std::runtime_error
  Holder(const std::filesystem::path& program, const std::filesystem::path& folder);
  /// Waits until the process has ended, and kills it after 5 s. @pre kEnd was sent, or the process
  /// is about to end.
  ~Holder();
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  int control() const { return control_.get(); }
  int events() const { return events_.get(); }

 private:
  FileDescriptor control_, events_;
  pid_t process_ = -1;
};

/// Finds one of our files: in `folder`, or if that is empty, beside this program or in
/// ../lib/baraka.
/// @throws std::runtime_error  it does not exist.
std::filesystem::path installed_file(const std::filesystem::path& folder, const char* name);

}  // namespace programs::netns
