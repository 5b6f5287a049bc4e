#pragma once

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// Both ends are closed in programs that are started.
struct Pipe {
  /// @throws std::runtime_error
  Pipe();
  FileDescriptor reader, writer;
};

/// What is written until all writers have closed it, or as much of it as is wanted.
std::string all_from(const FileDescriptor& reader, std::size_t wanted = std::string::npos);

}  // namespace programs::netns
