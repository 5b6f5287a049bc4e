#include "hal/routing/hello.h"

#include <utility>

namespace hal::routing {
namespace {

constexpr double kJitter = 0.25;  // of a period, at most: RFC 5148, 5.4
constexpr LinkTag kNoTag = 0;     // nobody misses a hello

Duration part_of(Duration whole, double fraction) {
  return Duration{static_cast<std::int64_t>(static_cast<double>(whole.count()) * fraction)};
}

}  // namespace

Hellos::Hellos(Node& node, Link& link, std::function<void(AgentId)> on_silence)
    : node_(node), link_(link), on_silence_(std::move(on_silence)) {}

void Hellos::start() {
  const Duration wait = part_of(node_.config.hello_period, node_.random.uniform());
  node_.timers.schedule(node_.now() + wait, [this] { schedule_next(); });
}

void Hellos::schedule_next() {
  const Duration period = node_.config.hello_period;
  link_.transmit(kEveryone, encode(Hello{period}), kNoTag);
  const Duration wait = period - part_of(period, kJitter * node_.random.uniform());
  node_.timers.schedule(node_.now() + wait, [this] { schedule_next(); });
}

void Hellos::on_heard(AgentId from) {
  const auto [watch, is_new] = watched_.try_emplace(from);
  watch->second.last_heard = node_.now();
  if (!is_new) return;
  watch->second.period = node_.config.hello_period;
  wait_for(from, watch->second);
}

void Hellos::on_hello(AgentId from, const Hello& hello) {
  on_heard(from);
  Watch& watch = watched_.at(from);
  if (watch.period == hello.period) return;
  watch.period = hello.period;
  node_.timers.cancel(watch.timer);
  wait_for(from, watch);
}

Time Hellos::deadline(const Watch& watch) const {
  return watch.last_heard + watch.period * node_.config.hello_limit + watch.period / 2;
}

/// The timer is not moved with every frame: when it runs, it looks whether it came too early.
void Hellos::wait_for(AgentId neighbour, Watch& watch) {
  watch.timer =
      node_.timers.schedule(deadline(watch), [this, neighbour] { on_deadline(neighbour); });
}

void Hellos::on_deadline(AgentId neighbour) {
  Watch& watch = watched_.at(neighbour);
  if (node_.now() < deadline(watch)) return wait_for(neighbour, watch);
  watched_.erase(neighbour);
  on_silence_(neighbour);
}

}  // namespace hal::routing
