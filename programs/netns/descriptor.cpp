#include "programs/netns/descriptor.h"

#include <cstring>

namespace programs::netns {

void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::strerror(error));
}

FileDescriptor open_file(const std::string& path, int flags, mode_t mode) {
  FileDescriptor file(open(path.c_str(), flags | O_CLOEXEC, mode));
  if (!file.is_open()) fail(path);
  return file;
}

}  // namespace programs::netns
