#include "sim/radio/rate/aarf.h"

#include <algorithm>

namespace sim::radio {
namespace {

constexpr std::uint32_t kFailuresInARow = 2;

}  // namespace

Aarf::Link& Aarf::link(hal::AgentId to) {
  return links_.try_emplace(to, Link{.threshold = config_.aarf_threshold}).first->second;
}

const PhyMode& Aarf::mode(hal::AgentId to, std::uint32_t, hal::Time) {
  return *ladder(to)[link(to).rung].mode;
}

void Aarf::on_result(hal::AgentId to, bool is_success) {
  Link& one = link(to);
  ++one.sent;
  if (is_success) {
    on_success(one, ladder(to).size() - 1);
  } else {
    on_failure(one);
  }
}

void Aarf::on_success(Link& link, std::size_t top) const {
  ++link.successes;
  link.failures = 0;
  link.probing = false;
  const std::uint64_t timeout =
      std::uint64_t{config_.aarf_timeout} * link.threshold / config_.aarf_threshold;
  const bool is_time = link.successes >= link.threshold || link.sent >= timeout;
  if (!is_time || link.rung == top) return;
  move(link, link.rung + 1);
  link.probing = true;
}

void Aarf::on_failure(Link& link) const {
  ++link.failures;
  link.successes = 0;
  if (link.probing) {
    link.threshold = std::min(2 * link.threshold, config_.aarf_max_threshold);
  } else if (link.failures >= kFailuresInARow) {
    link.threshold = config_.aarf_threshold;
  } else {
    return;
  }
  move(link, link.rung > 0 ? link.rung - 1 : 0);
}

void Aarf::move(Link& link, std::size_t rung) {
  link = {.rung = rung, .threshold = link.threshold};
}

}  // namespace sim::radio
