#pragma once

#include <string>

#include "programs/netns/descriptor.h"

namespace programs::netns {

/// A pipe; both ends are closed in programs that are started.
struct Pipe {
  /// @throws std::runtime_error
  Pipe();
  FileDescriptor reader, writer;
};

/// Reads until all writers have closed the pipe, or `wanted` bytes have been read.
std::string all_from(const FileDescriptor& reader, std::size_t wanted = std::string::npos);

}  // namespace programs::netns
