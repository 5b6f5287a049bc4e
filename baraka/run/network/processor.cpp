#include "baraka/run/network/processor.h"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace baraka::run::network {
namespace {

using programs::netns::FileDescriptor;

/// An abstract name of a socket is free again when the process ends, however it ends (unix(7)).
FileDescriptor reserve(int processor) {
  const std::string name = fmt::format("baraka/processor/{}", processor);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::ranges::copy(name, address.sun_path + 1);
  FileDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const bool is_free =
      ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), length) == 0;
  return is_free ? std::move(socket) : FileDescriptor();
}

}  // namespace

Processor::Processor() : number_(std::max(0, ::sched_getcpu())) {
  cpu_set_t allowed{};
  if (::sched_getaffinity(0, sizeof allowed, &allowed) != 0) return;
  for (int i = 0; i < CPU_SETSIZE && !reserved_.is_open(); ++i) {
    const int processor = (number_ + i) % CPU_SETSIZE;
    if (!CPU_ISSET(processor, &allowed)) continue;
    reserved_ = reserve(processor);
    if (reserved_.is_open()) number_ = processor;
  }
}

Processor::Use::Use(const Processor& processor) {
  ::sched_getaffinity(0, sizeof before_, &before_);
  cpu_set_t one{};
  CPU_SET(processor.number_, &one);
  ::sched_setaffinity(0, sizeof one, &one);
}

Processor::Use::~Use() { ::sched_setaffinity(0, sizeof before_, &before_); }

}  // namespace baraka::run::network
