#include "hal/robot/radio/udp_link.h"

#include <fmt/format.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "hal/robot/radio/datagram.h"
#include "hal/types/log.h"

namespace hal::robot::radio {
namespace {

constexpr int kOn = 1;
constexpr const char* kWhere = "radio";
constexpr std::size_t kBitsPerByte = 8;
/// Without a network it is searched for at this interval, in addition to the kernel's
/// notifications.
constexpr Duration kRetryAfter = std::chrono::seconds{1};
/// Octets added to a datagram: Ethernet 18, IPv4 20 (RFC 791), UDP 8 (RFC 768).
constexpr std::size_t kHeadersBelow = 46;
/// Maximum number of datagrams handled at once, so that a flood of them does not delay timers.
constexpr int kAtOnce = 64;

sockaddr_in socket_address(in_addr address, std::uint16_t port) {
  sockaddr_in in{};
  in.sin_family = AF_INET;
  in.sin_port = htons(port);
  in.sin_addr = address;
  return in;
}

// The sockets API takes addresses of every kind as sockaddr.
const sockaddr* generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}
sockaddr* generic(sockaddr_in& address) { return reinterpret_cast<sockaddr*>(&address); }

[[noreturn]] void give_up(int socket, const std::string& what) {
  const int error = errno;
  if (socket >= 0) ::close(socket);
  throw std::system_error(error, std::generic_category(), what);
}

/// Sends one datagram with the priority as the class selector of its DSCP. The kernel takes it from
/// a control message (ip(7), IP_TOS), and the priority of its own queues from that.
ssize_t send_datagram(int socket, Bytes datagram, sockaddr_in to, Priority priority) {
  constexpr int kBitsOfEcn = 2;  // below the DSCP (RFC 3168, 5)
  const int tos = dscp_of(priority) << kBitsOfEcn;
  alignas(cmsghdr) std::array<std::uint8_t, CMSG_SPACE(sizeof tos)> control{};
  iovec content{datagram.data(), datagram.size()};
  msghdr message{};
  message.msg_name = &to;
  message.msg_namelen = sizeof to;
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  if (tos != 0) {
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = IPPROTO_IP;
    header->cmsg_type = IP_TOS;
    header->cmsg_len = CMSG_LEN(sizeof tos);
    std::memcpy(CMSG_DATA(header), &tos, sizeof tos);
  }
  return sendmsg(socket, &message, MSG_DONTWAIT | MSG_NOSIGNAL);
}

std::uint16_t port_of(int socket) {
  sockaddr_in bound{};
  socklen_t size = sizeof bound;
  if (getsockname(socket, generic(bound), &size) != 0) return 0;
  return ntohs(bound.sin_port);
}

}  // namespace

UdpLink::UdpLink(const UdpLinkConfig& config, platform::EventLoop& loop)
    : config_(config), loop_(loop) {
  try {
    open(find_addresses(config_.interface, config_.address));
  } catch (const NoAddressYet& error) {
    trouble_ = error.what();
    retry_ = loop_.schedule(loop_.now() + kRetryAfter, [this] { renew(); });
  }
  try {
    interface_watch_.emplace(loop, [this] { renew(); });
  } catch (...) {
    loop_.cancel(retry_);
    close();
    throw;
  }
}

UdpLink::~UdpLink() {
  loop_.cancel(retry_);
  close();
}

/// @throws std::runtime_error  after closing everything.
void UdpLink::open(const UdpAddresses& addresses) {
  addresses_ = addresses;
  own_ = open_socket(addresses.own, false);
  if (config_.port == 0) config_.port = port_of(own_);
  try {
    broadcast_ = open_socket(addresses.broadcast, true);
  } catch (...) {
    close();
    throw;
  }
  watches_ = {loop_.watch(own_, [this] { receive(own_); }),
              loop_.watch(broadcast_, [this] { receive(broadcast_); })};
}

void UdpLink::close() {
  for (platform::EventLoop::Watch& watch : watches_) loop_.unwatch(std::exchange(watch, 0));
  for (int* socket : {&own_, &broadcast_}) {
    if (*socket >= 0) ::close(std::exchange(*socket, -1));
  }
}

/// Handles a change of interfaces, which need not concern this one.
void UdpLink::renew() {
  loop_.cancel(std::exchange(retry_, 0));
  const bool was_open = own_ >= 0;
  try {
    const UdpAddresses now = find_addresses(config_.interface, config_.address);
    if (was_open && now == addresses_) return;
    close();
    open(now);
    trouble_.clear();
    log::info(loop_.now(), kWhere, "{} is at {}", config_.interface, own_address());
  } catch (const std::runtime_error& error) {
    close();
    trouble_ = error.what();
    if (was_open) log::warning(loop_.now(), kWhere, "{}", trouble_);
    retry_ = loop_.schedule(loop_.now() + kRetryAfter, [this] { renew(); });
  }
}

/// @param shared  with other nodes of this computer: each gets a copy of a broadcast (socket(7)).
int UdpLink::open_socket(in_addr address, bool shared) const {
  const int socket = ::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) give_up(socket, "no UDP socket");
  setsockopt(socket, SOL_SOCKET, SO_BROADCAST, &kOn, sizeof kOn);
  if (shared) setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &kOn, sizeof kOn);
  // Distinguishes two interfaces in one network. It may be forbidden; the address then suffices.
  setsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, config_.interface.c_str(),
             static_cast<socklen_t>(config_.interface.size()));
  const sockaddr_in bound = socket_address(address, config_.port);
  if (bind(socket, generic(bound), sizeof bound) != 0) {
    give_up(socket,
            fmt::format("cannot use {}:{} for the radio", to_string(address), config_.port));
  }
  return socket;
}

void UdpLink::transmit(AgentId next_hop, Bytes frame, const node::routing::LinkOptions& options) {
  last_size_ = frame.size();
  if (!radio_on_) {
    ++counts_.radio_off;
    return;
  }
  sockaddr_in to = socket_address(addresses_.broadcast, config_.port);
  if (next_hop != kEveryone) {
    const auto known = neighbours_.find(next_hop);
    if (known == neighbours_.end()) {
      ++counts_.unknown_neighbour;
      return;
    }
    to = known->second;
  }
  if (frame.size() > kMaxFrame || own_ < 0) {
    ++counts_.not_sent;
    return;
  }
  const auto sent = send_datagram(own_, to_datagram(config_.self, frame), to, options.priority);
  sent < 0 ? ++counts_.not_sent : ++counts_.sent;
  note_error(sent < 0 ? errno : 0);
}

/// Ignores a full queue, which is normal; logs when any other error begins and when it ends.
void UdpLink::note_error(int error) {
  if (error == EAGAIN || error == ENOBUFS || error == EINTR || error == last_error_) return;
  last_error_ = error;
  if (error == 0) {
    log::info(loop_.now(), kWhere, "{} sends again", config_.interface);
  } else {
    log::warning(loop_.now(), kWhere, "{} does not send: {}", config_.interface,
                 std::strerror(error));
  }
}

void UdpLink::receive(int socket) {
  std::array<std::uint8_t, kDatagramHeader + kMaxFrame> buffer{};
  for (int i = 0; i < kAtOnce; ++i) {
    sockaddr_in from{};
    socklen_t size = sizeof from;
    const auto length = recvfrom(socket, buffer.data(), buffer.size(), MSG_DONTWAIT | MSG_TRUNC,
                                 generic(from), &size);
    if (length < 0) return;  // nothing left, or the network is down, which sending reports
    if (static_cast<std::size_t>(length) > buffer.size()) {
      ++counts_.malformed;
      continue;
    }
    take({buffer.data(), static_cast<std::size_t>(length)}, from);
  }
}

bool UdpLink::is_from_here(const sockaddr_in& from) const {
  return from.sin_addr.s_addr == addresses_.own.s_addr && ntohs(from.sin_port) == config_.port;
}

void UdpLink::take(std::span<const std::uint8_t> datagram, const sockaddr_in& from) {
  if (is_from_here(from)) {
    ++counts_.own;
    return;
  }
  const auto frame = from_datagram(datagram);
  if (!frame) {
    ++counts_.malformed;
    return;
  }
  if (ntohs(from.sin_port) != config_.port) {
    ++counts_.foreign;
    return;
  }
  if (frame->from == config_.self) {
    if (counts_.address_clashes++ == 0) {
      log::warning(loop_.now(), kWhere, "{} also has the agent address {}",
                   to_string(from.sin_addr), config_.self.value);
    }
    return;
  }
  if (!radio_on_) {
    ++counts_.radio_off;
    return;
  }
  neighbours_[frame->from] = from;
  ++counts_.received;
  if (on_frame_) on_frame_({.from = frame->from}, frame->bytes);
}

double UdpLink::airtime(std::size_t bytes) const {
  const std::size_t bits = kBitsPerByte * (bytes + kDatagramHeader + kHeadersBelow);
  return static_cast<double>(bits) / config_.bit_rate;
}

Duration UdpLink::expected_delay() const { return from_seconds(airtime(last_size_)); }

double UdpLink::transmit_energy(std::size_t bytes) const { return config_.power * airtime(bytes); }

std::string UdpLink::own_address() const {
  return own_ < 0 ? "nowhere yet" : fmt::format("{}:{}", to_string(addresses_.own), config_.port);
}

}  // namespace hal::robot::radio
