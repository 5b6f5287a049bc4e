#include "hal/node/agent/inbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hal::node::agent {
namespace {

/// Moves the items with times up to `until` to the end of `to`.
template <class At, class T>
void move_until(Time until, std::vector<At>& from, std::vector<T>& to) {
  auto rest = from.begin();
  for (; rest != from.end() && rest->time <= until; ++rest) to.push_back(std::move(rest->value));
  from.erase(from.begin(), rest);
}

/// Memory of lists that were taken, for the next events of any agent: that of the last list is
/// likely to be in the cache. One for each thread.
class SpareLists {
 public:
  using List = std::vector<exchange::Event>;

  List take() {
    List list;
    if (lists_.empty()) {
      list.reserve(kFew);
    } else {
      list.swap(lists_.back());
      lists_.pop_back();
    }
    return list;
  }

  void give(List&& list) {
    if (list.capacity() == 0 || list.capacity() > kMany) return;
    list.clear();
    lists_.push_back(std::move(list));
  }

 private:
  static constexpr std::size_t kFew = 2, kMany = 32;

  std::vector<List> lists_;
};

SpareLists& spare_lists() {
  static thread_local SpareLists lists;
  return lists;
}

}  // namespace

void Inbox::add(exchange::Event&& event) {
  if (events_.capacity() == 0) events_ = spare_lists().take();
  events_.push_back(std::move(event));
}

void Inbox::take(std::vector<exchange::Event>& to) {
  std::vector<exchange::Event> events = std::exchange(events_, {});
  const auto before = [](const auto& a, const auto& b) {
    return std::pair(a.time, a.cause()) < std::pair(b.time, b.cause());
  };
  if (!std::is_sorted(events.begin(), events.end(), before))
    std::stable_sort(events.begin(), events.end(), before);
  for (exchange::Event& event : events) {
    move_until(event.time, routes_, event.routes);
    if (!neighbours_.empty()) move_neighbours(event);
  }
  to.insert(to.end(), std::make_move_iterator(events.begin()),
            std::make_move_iterator(events.end()));
  spare_lists().give(std::move(events));
}

void Inbox::move_neighbours(exchange::Event& event) {
  std::vector<NeighbourChange> changes;
  move_until(event.time, neighbours_, changes);
  const auto id = [](const NeighbourChange& change) { return change.neighbour.id; };
  std::ranges::stable_sort(changes, {}, id);
  for (auto change = changes.begin(); change != changes.end(); ++change) {
    const auto next = std::next(change);
    const bool is_last_word = next == changes.end() || id(*next) != id(*change);
    if (!is_last_word) continue;
    if (change->lost) {
      event.lost_neighbours.push_back(id(*change));
    } else {
      event.neighbours.push_back(change->neighbour);
    }
  }
}

}  // namespace hal::node::agent
