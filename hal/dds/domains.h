#pragma once

#include <sys/types.h>

#include <array>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace hal::dds {

/// Servers of agents that fit into one DDS domain of one machine.
inline constexpr int kPlaces = 8;
/// Domains that take_domain() picks from without being told; told, it takes 0..kLastDomain too.
inline constexpr int kFirstFreeDomain = 1, kLastFreeDomain = 100;
/// The highest domain whose ports exist: they begin at 7400 + 250 * domain (OMG DDSI-RTPS 2.3,
/// 9.6.1.1).
inline constexpr int kLastDomain = 232;

/// Places of a server in a DDS domain, held until destruction or the death of the process: against
/// everybody in this network namespace, whichever user, as its ports are.
class DomainHold {
 public:
  ~DomainHold();
  DomainHold(DomainHold&& other) noexcept;
  DomainHold(const DomainHold&) = delete;
  DomainHold& operator=(const DomainHold&) = delete;
  DomainHold& operator=(DomainHold&&) = delete;

  int domain() const { return domain_; }
  int place() const { return place_; }  ///< 0..kPlaces-1: the participant id of the server.

 private:
  friend DomainHold take_domain(std::optional<int> domain);
  friend DomainHold join_domain(int domain);
  explicit DomainHold(int domain);
  bool lock(int place);

  int domain_;
  int place_ = 0;
  std::array<int, kPlaces> locks_;
};

/// Takes a whole domain for one simulator: the given one, or the first free one.
/// @throws std::runtime_error  if it is busy, naming who holds it; if none is free.
DomainHold take_domain(std::optional<int> domain);

/// Takes the first free place in a domain that others may share.
/// @throws std::runtime_error  if all places are taken, naming who holds the first.
DomainHold join_domain(int domain);

/// The users who hold places in a domain, each once.
/// @throws std::runtime_error  no file descriptor is left.
std::set<uid_t> users_in(int domain);

/// A mark that this process shows topics to tools in a domain, by which `baraka topic` finds it. It
/// lasts until destruction or the death of the process, and keeps nobody out: simulators and
/// daemons may share the domain. Beyond kPlaces of them in one domain, the others leave no mark.
class ShownDomain {
 public:
  /// @throws NoSuchDomain  @throws std::runtime_error  no file descriptor is left.
  explicit ShownDomain(int domain);
  ~ShownDomain();
  ShownDomain(const ShownDomain&) = delete;
  ShownDomain& operator=(const ShownDomain&) = delete;

 private:
  int lock_ = -1;
};

/// The domains with a ShownDomain of a user's process, ascending.
/// @throws std::runtime_error  no file descriptor is left.
std::vector<int> domains_shown_by(uid_t user);

/// UDP port at which the server at a place of a domain is discovered.
int discovery_port(int domain, int place);

/// Whether a server of some domain may want to be found at a UDP port.
bool may_be_a_servers(int port);

/// A UDP port of 127.0.0.1 that nobody uses now and at which no server is looked for. Another
/// process may take it before it is opened.
/// @throws std::runtime_error  no port is left, or no file descriptor.
int free_port();

/// Whoever named a domain named none: a mistake of the command line or the environment.
struct NoSuchDomain : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A domain as a variable of the environment has it. @throws NoSuchDomain  that names the variable.
int domain_in(const std::string& variable, const std::string& text);

/// The environment's BARAKA_DOMAIN, else 1.
/// @throws NoSuchDomain  if BARAKA_DOMAIN is none.
int default_domain();

}  // namespace hal::dds
