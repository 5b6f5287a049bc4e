#pragma once

#include <optional>
#include <string>
#include <vector>

namespace baraka::commands {

/// Sources of the domain other than --domain.
struct DomainHints {
  std::optional<std::string> baraka;  ///< BARAKA_DOMAIN
  std::vector<int> shown;  ///< Domains where this user's runs and daemons publish, ascending.
  std::optional<std::string> ros;  ///< ROS_DOMAIN_ID
};

/// The domain whose topics a tool reads, by the first of these that applies: --domain;
/// BARAKA_DOMAIN; the only domain in which runs and daemons of this user publish topics (with
/// `--inspect-domain`, that one); ROS_DOMAIN_ID; 1. A run precedes ROS_DOMAIN_ID, because users of
/// ROS 2 often set that in every shell. A run with `--no-inspect` publishes nothing.
/// @param asked  value of --domain.
/// @throws UsageError  topics are published in several domains.
/// @throws gateway::process::NoSuchDomain  BARAKA_DOMAIN or ROS_DOMAIN_ID is not a domain.
int chosen_domain(std::optional<int> asked, const DomainHints& hints);

/// The same with the present environment and runs.
int topic_domain(std::optional<int> asked);

}  // namespace baraka::commands
