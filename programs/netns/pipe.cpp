#include "programs/netns/pipe.h"

#include <algorithm>
#include <array>

namespace programs::netns {

Pipe::Pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("a pipe");
  reader.reset(ends[0]);
  writer.reset(ends[1]);
}

std::string all_from(const FileDescriptor& reader, std::size_t wanted) {
  std::string text;
  std::array<char, 512> part{};
  while (text.size() < wanted) {
    const std::size_t most = std::min(part.size(), wanted - text.size());
    const ssize_t length = read(reader.get(), part.data(), most);
    if (length == 0 || (length < 0 && errno != EINTR)) break;
    if (length > 0) text.append(part.data(), static_cast<std::size_t>(length));
  }
  return text;
}

}  // namespace programs::netns
