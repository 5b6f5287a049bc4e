#include "programs/topics/flows.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <stdexcept>
#include <string>

#include "programs/topics/schedule.h"

namespace programs::topics {
namespace {

/// Largest payload of a datagram over IPv4 (RFC 768, RFC 791). [byte]
constexpr std::uint32_t kMostPayload = 65507;

sockaddr_in address_of(const std::string& host, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1)
    throw std::runtime_error(host + " is not an IPv4 address");
  return address;
}

const sockaddr* pointer_to(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

int bound_socket(std::uint16_t port) {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = address_of("0.0.0.0", port);
  if (socket >= 0 && ::bind(socket, pointer_to(address), sizeof address) == 0) return socket;
  throw std::runtime_error("UDP port " + std::to_string(port) + ": " + std::strerror(errno));
}

std::int64_t wall_clock_ns() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::string text_of(const sockaddr_in& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  ::inet_ntop(AF_INET, &address.sin_addr, text.data(), text.size());
  return text.data();
}

}  // namespace

Flows::Flows(const Plan& plan, Instant begin, Journal& journal, Ending& ending)
    : journal_(journal), ending_(ending), over_(::eventfd(0, EFD_CLOEXEC)) {
  for (const std::uint16_t port : plan.ports) sockets_.push_back(bound_socket(port));
  for (std::size_t i = 0; i < sockets_.size(); ++i) {
    threads_.emplace_back(
        [this, socket = sockets_[i], port = plan.ports[i]] { receive(socket, port); });
  }
  for (const SentFlow& flow : plan.flows)
    threads_.emplace_back([this, &flow, begin] { send(flow, begin); });
}

Flows::~Flows() {
  const std::uint64_t one = 1;
  if (::write(over_, &one, sizeof one) < 0) std::perror("eventfd");
  for (std::thread& thread : threads_) thread.join();
  for (const int socket : sockets_) ::close(socket);
  ::close(over_);
}

void Flows::send(const SentFlow& flow, Instant begin) const {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const std::vector<char> payload(kMostPayload);
  for (std::uint64_t index = 0; true; ++index) {
    const auto due = sample_of(flow.datagrams, index);
    if (!due || !ending_.sleep_until(begin + due->at)) break;
    for (const std::string& to : flow.to) {
      const sockaddr_in address = address_of(to, flow.port);
      const auto sent = ::sendto(socket, payload.data(), std::min(due->bytes, kMostPayload), 0,
                                 pointer_to(address), sizeof address);
      journal_.sent(flow.port, sent >= 0);
    }
  }
  ::close(socket);
}

void Flows::receive(int socket, std::uint16_t port) const {
  std::array<pollfd, 2> waits{{{socket, POLLIN, 0}, {over_, POLLIN, 0}}};
  std::vector<char> payload(kMostPayload);
  while (::poll(waits.data(), waits.size(), -1) > 0 || errno == EINTR) {
    if ((waits[1].revents & POLLIN) != 0) return;
    sockaddr_in from{};
    socklen_t length = sizeof from;
    const auto got = ::recvfrom(socket, payload.data(), payload.size(), MSG_DONTWAIT,
                                reinterpret_cast<sockaddr*>(&from), &length);
    if (got >= 0) journal_.received_datagram(port, text_of(from), wall_clock_ns());
  }
}

}  // namespace programs::topics
