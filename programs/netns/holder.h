#pragma once

#include <sys/types.h>

#include <filesystem>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// The process baraka-holder and the two sockets to what it makes.
class Holder {
 public:
  /// Starts it. @param folder  its working folder, by which running_runs() finds the run.
  /// @throws std::runtime_error
  Holder(const std::filesystem::path& program, const std::filesystem::path& folder);
  /// Waits until it has ended, and after 5 s ends it. @pre kEnd was sent, or its end is near.
  ~Holder();
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  int control() const { return control_.get(); }
  int events() const { return events_.get(); }

 private:
  FileDescriptor control_, events_;
  pid_t process_ = -1;
};

/// A file of ours beside this program or in ../lib/baraka; or in `folder`, if it is not empty.
/// @throws std::runtime_error  it is not there.
std::filesystem::path installed_file(const std::filesystem::path& folder, const char* name);

}  // namespace programs::netns
