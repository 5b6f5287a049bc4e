#include "gateway/commands/topic_domain.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "gateway/exit_status.h"
#include "hal/dds/domains.h"

namespace gateway {
namespace {

std::optional<std::string> variable(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr || *text == '\0' ? std::nullopt : std::optional<std::string>(text);
}

}  // namespace

int chosen_domain(std::optional<int> asked, const DomainHints& hints) {
  if (asked) return *asked;
  if (hints.baraka) return hal::dds::domain_in("BARAKA_DOMAIN", *hints.baraka);
  if (hints.under_way.size() > 1) {
    throw UsageError(
        fmt::format("runs or daemons are under way in the domains {}: say by --domain "
                    "which one is meant",
                    fmt::join(hints.under_way, ", ")));
  }
  if (!hints.under_way.empty()) return hints.under_way.front();
  constexpr int kDefault = 1;
  return hints.ros ? hal::dds::domain_in("ROS_DOMAIN_ID", *hints.ros) : kDefault;
}

int topic_domain(std::optional<int> asked) {
  if (asked) return *asked;
  return chosen_domain(asked, {.baraka = variable("BARAKA_DOMAIN"),
                               .under_way = hal::dds::domains_of(::geteuid()),
                               .ros = variable("ROS_DOMAIN_ID")});
}

}  // namespace gateway
