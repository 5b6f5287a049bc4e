#include "sim/agents/inbox.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace sim::agents {
namespace {

/// Moves what happened up to `until` to the end of `to`.
template <class At, class T>
void move_until(hal::Time until, std::vector<At>& from, std::vector<T>& to) {
  auto rest = from.begin();
  for (; rest != from.end() && rest->time <= until; ++rest) to.push_back(std::move(rest->value));
  from.erase(from.begin(), rest);
}

/// A neighbour that was heard several times is reported once, as it was heard last.
void keep_latest(std::vector<hal::Neighbour>& heard) {
  std::stable_sort(heard.begin(), heard.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  const auto older = [](const auto& a, const auto& b) { return a.id == b.id; };
  // unique keeps the first of equals; the latest is last, so look from behind
  const auto begin = std::unique(heard.rbegin(), heard.rend(), older).base();
  heard.erase(heard.begin(), begin);
}

}  // namespace

std::vector<hal::exchange::Event> Inbox::take() {
  std::vector<hal::exchange::Event> events = std::exchange(events_, {});
  const auto before = [](const auto& a, const auto& b) {
    return std::tie(a.time, a.cause) < std::tie(b.time, b.cause);
  };
  if (!std::is_sorted(events.begin(), events.end(), before))
    std::stable_sort(events.begin(), events.end(), before);
  for (hal::exchange::Event& event : events) {
    move_until(event.time, routes_, event.routes);
    move_until(event.time, neighbours_, event.neighbours);
    if (event.neighbours.size() > 1) keep_latest(event.neighbours);
    move_until(event.time, lost_, event.lost_neighbours);
  }
  return events;
}

}  // namespace sim::agents
