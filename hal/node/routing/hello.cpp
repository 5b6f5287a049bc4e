#include "hal/node/routing/hello.h"

#include <algorithm>
#include <utility>

namespace hal::node::routing {
namespace {

constexpr double kJitter = 0.25;  // share of a period, at most: RFC 5148, 5.4
constexpr LinkTag kNoTag = 0;     // results of hellos are ignored

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
  link_.transmit(kEveryone, encode(Hello{period}), {kNoTag, node_.config.control_priority});
  node_.count(ProtocolEvent::kHelloSent);
  const Duration wait = period - part_of(period, kJitter * node_.random.uniform());
  node_.timers.schedule(node_.now() + wait, [this] { schedule_next(); });
}

Hellos::Watch& Hellos::watch_of(AgentId neighbour) {
  const auto place = std::ranges::lower_bound(watched_, neighbour, {}, &Watch::neighbour);
  if (place != watched_.end() && place->neighbour == neighbour) return *place;
  const Watch watch{neighbour, node_.now(), node_.config.hello_period};
  wait_for(watch);
  return *watched_.insert(place, watch);
}

void Hellos::on_heard(AgentId from) { watch_of(from).last_heard = node_.now(); }

void Hellos::on_hello(AgentId from, const Hello& hello) {
  Watch& watch = watch_of(from);
  watch.last_heard = node_.now();
  if (watch.period == hello.period) return;
  watch.period = hello.period;
  wait_for(watch);
}

Time Hellos::deadline(const Watch& watch) const {
  return watch.last_heard + watch.period * node_.config.hello_limit + watch.period / 2;
}

/// Uses one timer for all neighbours, set to the first deadline. It is not moved with every frame:
/// when it fires, it checks who has been heard since.
void Hellos::wait_for(const Watch& watch) {
  if (!wake_at_ || deadline(watch) < *wake_at_) wait_until(deadline(watch));
}

void Hellos::wait_until(Time deadline) {
  if (wake_at_) node_.timers.cancel(timer_);
  wake_at_ = deadline;
  timer_ = node_.timers.schedule(deadline, [this] { on_deadline(); });
}

void Hellos::on_deadline() {
  wake_at_.reset();
  const auto is_silent = [this](const Watch& watch) { return deadline(watch) <= node_.now(); };
  std::vector<AgentId> silent;
  for (const Watch& watch : watched_)
    if (is_silent(watch)) silent.push_back(watch.neighbour);
  std::erase_if(watched_, is_silent);
  const auto first = std::ranges::min_element(
      watched_, {}, [this](const Watch& watch) { return deadline(watch); });
  if (first != watched_.end()) wait_until(deadline(*first));
  for (const AgentId neighbour : silent) on_silence_(neighbour);
}

}  // namespace hal::node::routing
