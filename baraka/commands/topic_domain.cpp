#include "baraka/commands/topic_domain.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "gateway/process/domains.h"
#include "gateway/process/exit_status.h"

namespace baraka::commands {
namespace {

std::optional<std::string> variable(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr || *text == '\0' ? std::nullopt : std::optional<std::string>(text);
}

}  // namespace

int chosen_domain(std::optional<int> asked, const DomainHints& hints) {
  if (asked) return *asked;
  if (hints.baraka) return gateway::process::domain_in("BARAKA_DOMAIN", *hints.baraka);
  if (hints.shown.size() > 1) {
    throw gateway::process::UsageError(
        fmt::format("runs or daemons show topics in the domains {}: choose one by --domain N",
                    fmt::join(hints.shown, ", ")));
  }
  if (!hints.shown.empty()) return hints.shown.front();
  constexpr int kDefault = 1;
  return hints.ros ? gateway::process::domain_in("ROS_DOMAIN_ID", *hints.ros) : kDefault;
}

int topic_domain(std::optional<int> asked) {
  if (asked) return *asked;
  return chosen_domain(asked, {.baraka = variable("BARAKA_DOMAIN"),
                               .shown = gateway::process::domains_shown_by(::geteuid()),
                               .ros = variable("ROS_DOMAIN_ID")});
}

}  // namespace baraka::commands
