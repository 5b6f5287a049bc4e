#include "gateway/process/domains.h"

#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace gateway::process {
namespace {

constexpr int kFirstPort = 7400;      // PB and …
constexpr int kPortsPerDomain = 250;  // … DG of OMG DDSI-RTPS 2.3, 9.6.1.1

/// The use of a place of a domain; part of the name of the socket that holds the place.
constexpr std::string_view kServers = "domain", kShown = "shown";

struct DomainPlace {
  std::string_view use;
  int domain, number;
};

/// Name of the Unix socket that holds a place of a domain. The name is abstract, so the socket is
/// not in the file system: it is visible to all users in this network namespace, which also has the
/// domain's ports; it cannot be a link or be left behind; and the kernel knows its owner (unix(7),
/// abstract sockets).
sockaddr_un lock_name(const DomainPlace& place, socklen_t& size) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("baraka-{}-{}-{}", place.use, place.domain, place.number);
  name.copy(address.sun_path + 1, sizeof(address.sun_path) - 1);
  size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  return address;
}

/// @throws std::runtime_error  no file descriptor is left.
int unix_socket() {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor >= 0) return descriptor;
  throw std::runtime_error(fmt::format("a Unix socket: {}", std::strerror(errno)));
}

/// @return a socket that holds the place until it is closed; -1: another process holds it.
/// @throws std::runtime_error  the place cannot be held by any process.
int hold_place(const DomainPlace& place) {
  const int descriptor = unix_socket();
  socklen_t size = 0;
  const sockaddr_un address = lock_name(place, size);
  // Only a listening socket reveals its owner.
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
      listen(descriptor, SOMAXCONN) == 0) {
    return descriptor;
  }
  const int error = errno;
  close(descriptor);
  if (error == EADDRINUSE) return -1;
  throw std::runtime_error(fmt::format("DDS domain {}: {}", place.domain, std::strerror(error)));
}

std::string program_of(pid_t pid) {
  std::error_code error;
  const auto path = std::filesystem::read_symlink(fmt::format("/proc/{}/exe", pid), error);
  if (!error) return path.filename().string();
  std::ifstream file(fmt::format("/proc/{}/comm", pid));  // the process of another user
  std::string name;
  return std::getline(file, name) ? name : "unknown";
}

/// The process that holds a place of a domain; none: there is none, or it cannot be determined.
std::optional<ucred> credentials_at(const DomainPlace& place) {
  const int descriptor = unix_socket();
  socklen_t size = 0;
  const sockaddr_un address = lock_name(place, size);
  ucred holder{};
  socklen_t length = sizeof(holder);
  const bool is_known =
      connect(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
      getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &holder, &length) == 0;
  close(descriptor);
  return is_known ? std::optional(holder) : std::nullopt;
}

/// "pid 12 (baraka)".
std::string holder_of(int domain, int place) {
  const auto holder = credentials_at({kServers, domain, place});
  if (!holder || holder->pid <= 0) return "another process";
  return fmt::format("pid {} ({})", holder->pid, program_of(holder->pid));
}

void require_domain(int domain) {
  if (domain >= 0 && domain <= kLastDomain) return;
  throw NoSuchDomain(fmt::format("there is no DDS domain {}: it is 0 to {}", domain, kLastDomain));
}

/// Binds a UDP socket of the loopback interface for a moment. @param port  0: any free port.
/// @return the port; 0: it could not be bound, and errno is set.
int bound_port(int port) {
  const int probe = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (probe < 0) return 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const raw = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof(address);
  const bool is_bound = bind(probe, raw, size) == 0 && getsockname(probe, raw, &size) == 0;
  const int error = errno;
  close(probe);
  errno = error;
  return is_bound ? ntohs(address.sin_port) : 0;
}

bool is_port_free(int port) { return bound_port(port) != 0 || errno != EADDRINUSE; }

/// A port of the domain's places that is used by a program that is not ours.
std::optional<int> port_in_use(int domain) {
  for (int place = 0; place < kPlaces; ++place) {
    if (const int port = discovery_port(domain, place); !is_port_free(port)) return port;
  }
  return std::nullopt;
}

/// The holder of the first place of a domain that is held, for messages.
std::string first_holder(int domain) {
  for (int place = 0; place < kPlaces; ++place) {
    const int descriptor = hold_place({kServers, domain, place});
    if (descriptor < 0) return holder_of(domain, place);
    close(descriptor);
  }
  return "another process";
}

/// The users who hold places of a domain.
std::set<uid_t> holders(std::string_view use, int domain) {
  std::set<uid_t> users;
  for (int place = 0; place < kPlaces; ++place) {
    if (const auto holder = credentials_at({use, domain, place})) users.insert(holder->uid);
  }
  return users;
}

}  // namespace

std::set<uid_t> users_in(int domain) { return holders(kServers, domain); }

std::vector<int> domains_shown_by(uid_t user) {
  std::vector<int> domains;
  for (int domain = 0; domain <= kLastDomain; ++domain) {
    if (holders(kShown, domain).contains(user)) domains.push_back(domain);
  }
  return domains;
}

ShownDomain::ShownDomain(int domain) {
  require_domain(domain);
  for (int place = 0; place < kPlaces && lock_ < 0; ++place) {
    lock_ = hold_place({kShown, domain, place});
  }
}

ShownDomain::~ShownDomain() {
  if (lock_ >= 0) close(lock_);
}

int discovery_port(int domain, int place) {
  // OMG DDSI-RTPS 2.3, 9.6.1.1: PB + DG * domain + d1 + PG * participant.
  return kFirstPort + kPortsPerDomain * domain + 10 + 2 * place;
}

bool may_be_a_servers(int port) {
  const int offset = (port - kFirstPort) % kPortsPerDomain;
  return port >= kFirstPort && offset <= discovery_port(0, kPlaces) - kFirstPort;
}

int free_port() {
  while (true) {
    const int port = bound_port(0);
    if (port == 0) {
      throw std::runtime_error(fmt::format("no UDP port of 127.0.0.1: {}", std::strerror(errno)));
    }
    if (!may_be_a_servers(port)) return port;
  }
}

DomainHold::DomainHold(int domain) : domain_(domain) { locks_.fill(-1); }

DomainHold::DomainHold(DomainHold&& other) noexcept
    : domain_(other.domain_), place_(other.place_), locks_(other.locks_) {
  other.locks_.fill(-1);
}

DomainHold::~DomainHold() {
  for (const int descriptor : locks_) {
    if (descriptor >= 0) close(descriptor);
  }
}

bool DomainHold::lock(int place) {
  const int descriptor = hold_place({kServers, domain_, place});
  if (descriptor < 0) return false;
  locks_.at(static_cast<std::size_t>(place)) = descriptor;
  return true;
}

DomainHold take_domain(std::optional<int> domain) {
  if (domain) require_domain(*domain);
  const int first = domain.value_or(kFirstFreeDomain);
  const int last = domain.value_or(kLastFreeDomain);
  for (int candidate = first; candidate <= last; ++candidate) {
    DomainHold hold(candidate);
    int place = 0;
    while (place < kPlaces && hold.lock(place)) ++place;
    if (place < kPlaces) continue;
    const auto port = port_in_use(candidate);
    if (!port) return hold;
    if (domain) {
      throw std::runtime_error(
          fmt::format("DDS domain {} is busy: its UDP port {} is in use", *domain, *port));
    }
  }
  if (!domain)
    throw std::runtime_error(fmt::format("DDS domains {} to {} are all busy", first, last));
  throw std::runtime_error(
      fmt::format("DDS domain {} is busy: {} holds it", *domain, first_holder(*domain)));
}

DomainHold join_domain(int domain) {
  require_domain(domain);
  DomainHold hold(domain);
  for (int place = 0; place < kPlaces; ++place) {
    if (!hold.lock(place)) continue;
    hold.place_ = place;
    return hold;
  }
  throw std::runtime_error(fmt::format("all {} places of DDS domain {} are taken, the first by {}",
                                       kPlaces, domain, holder_of(domain, 0)));
}

int domain_in(const std::string& variable, const std::string& text) {
  int domain = -1;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, domain);
  if (error == std::errc{} && end == last && domain >= 0 && domain <= kLastDomain) return domain;
  throw NoSuchDomain(
      fmt::format("{} is '{}', not a DDS domain from 0 to {}", variable, text, kLastDomain));
}

int default_domain() {
  const char* const text = std::getenv("BARAKA_DOMAIN");
  return text == nullptr || *text == '\0' ? 1 : domain_in("BARAKA_DOMAIN", text);
}

}  // namespace gateway::process
