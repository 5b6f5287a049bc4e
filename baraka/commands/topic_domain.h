#pragma once

#include <optional>
#include <string>
#include <vector>

namespace baraka::commands {

/// What a domain can be told by, but for --domain.
struct DomainHints {
  std::optional<std::string> baraka;  ///< BARAKA_DOMAIN
  std::vector<int> shown;          ///< Where this user's runs and daemons show topics, ascending.
  std::optional<std::string> ros;  ///< ROS_DOMAIN_ID
};

/// The domain whose topics a tool looks at: --domain, else BARAKA_DOMAIN, else the only one in
/// which runs and daemons of this user show topics (that of `--inspect-domain`, if they were given
/// one), else ROS_DOMAIN_ID, else 1. A run comes before ROS_DOMAIN_ID, which shells of ROS 2's
/// users set for whatever they do. A run with `--no-inspect` shows nothing.
/// @param asked  by --domain. @throws UsageError  topics are shown in several domains.
/// @throws gateway::process::NoSuchDomain  BARAKA_DOMAIN or ROS_DOMAIN_ID is none.
int chosen_domain(std::optional<int> asked, const DomainHints& hints);

/// The same with the hints that there are now.
int topic_domain(std::optional<int> asked);

}  // namespace baraka::commands
