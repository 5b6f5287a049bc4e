#include "programs/netns/message.h"

#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <array>
#include <cstring>

namespace programs::netns {
namespace {

constexpr std::size_t kMostDescriptors = 250;  // SCM_MAX_FD of Linux: 253
constexpr std::size_t kLongest = 32'768;       // bytes of content in the message itself

struct Envelope {
  MessageKind kind = MessageKind::kEnd;
  std::uint32_t is_file = 0;  ///< Whether the content is in the first descriptor.
};

union Control {
  cmsghdr header;
  std::array<char, CMSG_SPACE(kMostDescriptors * sizeof(int))> bytes;
};

FileDescriptor file_of(const std::string& content) {
  FileDescriptor file(memfd_create("baraka", MFD_CLOEXEC));
  if (!file.is_open()) fail("a message to the namespaces");
  std::size_t written = 0;
  while (written < content.size()) {
    const ssize_t more = write(file.get(), content.data() + written, content.size() - written);
    if (more < 0) fail("a message to the namespaces");
    written += static_cast<std::size_t>(more);
  }
  return file;
}

std::string content_of(int file) {
  struct stat status {};
  if (fstat(file, &status) != 0) fail("a message of the namespaces");
  std::string content(static_cast<std::size_t>(status.st_size), '\0');
  if (pread(file, content.data(), content.size(), 0) != status.st_size) {
    fail("a message of the namespaces");
  }
  return content;
}

std::vector<FileDescriptor> descriptors_of(msghdr& message) {
  std::vector<FileDescriptor> descriptors;
  for (cmsghdr* control = CMSG_FIRSTHDR(&message); control != nullptr;
       control = CMSG_NXTHDR(&message, control)) {
    if (control->cmsg_level != SOL_SOCKET || control->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (control->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int descriptor = -1;
      std::memcpy(&descriptor, CMSG_DATA(control) + i * sizeof(int), sizeof(int));
      descriptors.emplace_back(descriptor);
    }
  }
  return descriptors;
}

}  // namespace

void send(int socket, MessageKind kind, const std::string& content,
          std::span<const int> descriptors) {
  Envelope envelope{kind, content.size() > kLongest ? 1U : 0U};
  FileDescriptor file;
  std::vector<int> all(descriptors.begin(), descriptors.end());
  if (envelope.is_file != 0) {
    file = file_of(content);
    all.insert(all.begin(), file.get());
  }
  if (all.size() > kMostDescriptors) fail("too many descriptors for one program", EINVAL);
  std::array<iovec, 2> parts{iovec{&envelope, sizeof envelope},
                             iovec{const_cast<char*>(content.data()), content.size()}};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = envelope.is_file != 0 ? 1 : 2;
  Control control{};
  if (!all.empty()) {
    message.msg_control = &control;
    message.msg_controllen = CMSG_SPACE(all.size() * sizeof(int));
    control.header = {CMSG_LEN(all.size() * sizeof(int)), SOL_SOCKET, SCM_RIGHTS};
    std::memcpy(CMSG_DATA(&control.header), all.data(), all.size() * sizeof(int));
  }
  while (sendmsg(socket, &message, MSG_NOSIGNAL) < 0) {
    if (errno == EPIPE || errno == ECONNRESET) throw std::runtime_error(kGone);
    if (errno != EINTR) fail("the namespaces of the run");
  }
}

std::optional<Message> receive(int socket) {
  Envelope envelope;
  Message received;
  received.content.resize(kLongest);
  std::array<iovec, 2> parts{iovec{&envelope, sizeof envelope},
                             iovec{received.content.data(), received.content.size()}};
  Control control{};
  msghdr message{};
  message.msg_iov = parts.data();
  message.msg_iovlen = parts.size();
  message.msg_control = &control;
  message.msg_controllen = sizeof control;
  ssize_t length = -1;
  while ((length = recvmsg(socket, &message, MSG_CMSG_CLOEXEC)) < 0) {
    // The other end closed without reading everything; its last message may still be there.
    if (errno != EINTR && errno != ECONNRESET) fail("the namespaces of the run");
  }
  if (static_cast<std::size_t>(length) < sizeof envelope) return std::nullopt;  // closed
  received.kind = envelope.kind;
  received.content.resize(static_cast<std::size_t>(length) - sizeof envelope);
  received.descriptors = descriptors_of(message);
  if (envelope.is_file != 0 && !received.descriptors.empty()) {
    received.content = content_of(received.descriptors.front().get());
    received.descriptors.erase(received.descriptors.begin());
  }
  return received;
}

}  // namespace programs::netns
