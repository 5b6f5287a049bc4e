#pragma once

#include <sys/types.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gateway/process/exit_status.h"

namespace gateway::process {

/// Maximum number of servers of agents in one DDS domain of one machine.
inline constexpr int kPlaces = 8;
/// Domains from which take_domain() picks by itself; on request it takes any of 0..kLastDomain.
inline constexpr int kFirstFreeDomain = 1, kLastFreeDomain = 100;
/// The highest domain whose ports exist: they begin at 7400 + 250 * domain (OMG DDSI-RTPS 2.3,
/// 9.6.1.1).
inline constexpr int kLastDomain = 232;

/// Exclusive places of a server in a DDS domain, held until destruction or the death of the
/// process. Like ports, they are exclusive among all users of this network namespace.
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
/// @throws std::runtime_error  if it is busy, with the holder's name; if none is free.
DomainHold take_domain(std::optional<int> domain);

/// Takes the first free place in a domain that may be shared.
/// @throws std::runtime_error  if all places are taken, with the name of the first place's holder.
DomainHold join_domain(int domain);

/// The users who hold places in a domain, each once.
/// @throws std::runtime_error  no file descriptor is left.
std::set<uid_t> users_in(int domain);

/// A mark that this process publishes topics for tools in a domain, so that `baraka topic` finds
/// it. It lasts until destruction or the death of the process and is not exclusive: simulators and
/// daemons can share the domain. At most kPlaces processes have a mark in a domain.
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

/// The domains with a ShownDomain of one of a user's processes, in ascending order.
/// @throws std::runtime_error  no file descriptor is left.
std::vector<int> domains_shown_by(uid_t user);

/// UDP port for discovery of the server at a place of a domain.
int discovery_port(int domain, int place);

/// Whether a UDP port is the discovery port of a server in any domain.
bool may_be_a_servers(int port);

/// A UDP port of 127.0.0.1 that is unused now and not a discovery port of a server. Another process
/// can take it before it is opened.
/// @throws std::runtime_error  no port or no file descriptor is left.
int free_port();

/// The command line or the environment names an invalid domain.
struct NoSuchDomain : UsageError {
  using UsageError::UsageError;
};

/// The domain in an environment variable. @throws NoSuchDomain  with the name of the variable.
int domain_in(const std::string& variable, const std::string& text);

/// The environment's BARAKA_DOMAIN, else 1.
/// @throws NoSuchDomain  if BARAKA_DOMAIN is not a domain.
int default_domain();

}  // namespace gateway::process
