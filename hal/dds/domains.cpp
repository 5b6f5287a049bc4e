#include "hal/dds/domains.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <netinet/in.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace hal::dds {
namespace {

constexpr int kFirstPort = 7400;      // PB and …
constexpr int kPortsPerDomain = 250;  // … DG of OMG DDSI-RTPS 2.3, 9.6.1.1

std::string lock_path(int domain, int place) {
  const auto folder = std::filesystem::temp_directory_path();
  return folder / fmt::format("baraka-domain-{}-{}.lock", domain, place);
}

/// @throws std::runtime_error  if the file can be neither opened nor made.
int open_lock(const std::string& path) {
  // An existing file must be opened without O_CREAT: in a sticky folder Linux refuses that for
  // files of other users (proc(5), fs.protected_regular).
  int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) {
    file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) fchmod(file, 0666);  // Past the umask: every user may hold a domain.
  }
  if (file < 0 && errno == EEXIST) file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) throw std::runtime_error(fmt::format("{}: {}", path, std::strerror(errno)));
  return file;
}

std::string this_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? "unknown" : path.filename().string();
}

/// "pid 12 (baraka)".
std::string holder_of(int domain, int place) {
  std::ifstream file(lock_path(domain, place));
  std::string holder;
  return std::getline(file, holder) ? holder : "another process";
}

void require_domain(int domain) {
  if (domain >= 0 && domain <= kLastDomain) return;
  throw NoSuchDomain(fmt::format("there is no DDS domain {}: it is 0 to {}", domain, kLastDomain));
}

/// Binds a UDP socket of the loopback interface for a moment. @param port  0: whichever is free.
/// @return the port it had; 0: none, errno says why.
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

/// Whether a port is none at which the server of some domain may want to be found.
bool is_nobodys(int port) {
  const int offset = (port - kFirstPort) % kPortsPerDomain;
  return port < kFirstPort || offset > discovery_port(0, kPlaces) - kFirstPort;
}

bool is_port_free(int port) { return bound_port(port) != 0 || errno != EADDRINUSE; }

/// The port of a domain's places that somebody uses who cannot be seen in the lock files: a program
/// that is none of ours, or one in a container with folders of its own.
std::optional<int> port_in_use(int domain) {
  for (int place = 0; place < kPlaces; ++place) {
    if (const int port = discovery_port(domain, place); !is_port_free(port)) return port;
  }
  return std::nullopt;
}

/// The first place of a domain that cannot be had, for the message.
std::string first_holder(int domain) {
  for (int place = 0; place < kPlaces; ++place) {
    const int file = open_lock(lock_path(domain, place));
    const bool is_free = flock(file, LOCK_EX | LOCK_NB) == 0;
    close(file);
    if (!is_free) return holder_of(domain, place);
  }
  return "another process";
}

}  // namespace

int discovery_port(int domain, int place) {
  // OMG DDSI-RTPS 2.3, 9.6.1.1: PB + DG * domain + d1 + PG * participant.
  return kFirstPort + kPortsPerDomain * domain + 10 + 2 * place;
}

int free_port() {
  while (true) {
    const int port = bound_port(0);
    if (port == 0) {
      throw std::runtime_error(fmt::format("no UDP port of 127.0.0.1: {}", std::strerror(errno)));
    }
    if (is_nobodys(port)) return port;
  }
}

DomainHold::DomainHold(int domain) : domain_(domain) { locks_.fill(-1); }

DomainHold::DomainHold(DomainHold&& other) noexcept
    : domain_(other.domain_), place_(other.place_), locks_(other.locks_) {
  other.locks_.fill(-1);
}

DomainHold::~DomainHold() {
  // The files stay: deleting one that another process is about to lock would make two of it.
  for (const int file : locks_) {
    if (file >= 0) close(file);
  }
}

bool DomainHold::lock(int place) {
  const int file = open_lock(lock_path(domain_, place));
  if (flock(file, LOCK_EX | LOCK_NB) != 0) {
    close(file);
    return false;
  }
  const std::string holder = fmt::format("pid {} ({})\n", getpid(), this_program());
  if (ftruncate(file, 0) != 0 || write(file, holder.data(), holder.size()) < 0) {
    close(file);
    return false;
  }
  locks_.at(static_cast<std::size_t>(place)) = file;
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

int default_domain() {
  const char* text = std::getenv("BARAKA_DOMAIN");
  if (text == nullptr || *text == '\0') return 1;
  const std::string_view view = text;
  int domain = -1;
  const auto [end, error] = std::from_chars(view.data(), view.data() + view.size(), domain);
  if (error == std::errc{} && end == view.data() + view.size() && domain >= 0 &&
      domain <= kLastDomain) {
    return domain;
  }
  throw NoSuchDomain(
      fmt::format("BARAKA_DOMAIN is '{}', not a DDS domain from 0 to {}", view, kLastDomain));
}

}  // namespace hal::dds
