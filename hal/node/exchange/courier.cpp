#include "hal/node/exchange/courier.h"

#include <algorithm>
#include <iterator>

#include "hal/types/check.h"

namespace hal::node::exchange {
namespace {

bool contains(const std::vector<Neighbour>& neighbours, AgentId id) {
  return std::ranges::find(neighbours, id, &Neighbour::id) != neighbours.end();
}

bool contains(const std::vector<AgentId>& agents, AgentId id) {
  return std::ranges::find(agents, id) != agents.end();
}

bool is_same_entry(const Route& a, const Route& b) {
  return a.destination == b.destination && a.next_hop == b.next_hop && a.topic == b.topic;
}

}  // namespace

void absorb(Event earlier, Event& later) {
  for (Reading& reading : earlier.readings) {
    const bool is_newer = std::ranges::find(later.readings, reading.channel, &Reading::channel) !=
                          later.readings.end();
    if (!is_newer) later.readings.push_back(std::move(reading));
  }
  // Only the latest change of a route counts: the changes that wait for a halted controller must
  // not accumulate.
  std::erase_if(earlier.routes, [&later](const RouteChange& change) {
    return std::ranges::any_of(later.routes, [&change](const RouteChange& newer) {
      return is_same_entry(newer.route, change.route);
    });
  });
  earlier.routes.insert(earlier.routes.end(), std::make_move_iterator(later.routes.begin()),
                        std::make_move_iterator(later.routes.end()));
  later.routes = std::move(earlier.routes);
  // A receiver processes the neighbours of an event before its lost neighbours.
  for (const AgentId lost : earlier.lost_neighbours) {
    if (!contains(later.neighbours, lost) && !contains(later.lost_neighbours, lost)) {
      later.lost_neighbours.push_back(lost);
    }
  }
  for (const Neighbour& heard : earlier.neighbours) {
    if (contains(earlier.lost_neighbours, heard.id)) continue;
    if (contains(later.neighbours, heard.id) || contains(later.lost_neighbours, heard.id)) continue;
    later.neighbours.push_back(heard);
  }
}

Courier::Courier(std::shared_ptr<ControllerPort> port, std::size_t capacity)
    : port_(std::move(port)), capacity_(capacity) {}

void Courier::post(Event event) {
  const bool is_bound = event.cause() != Cause::kStart && event.cause() != Cause::kStop;
  if (event.cause() == Cause::kControl) supersede_cycle(event);
  if (is_bound && waiting_.size() >= capacity_) return lose(std::move(event));
  if (const auto carried = carried_.find(event.agent); carried != carried_.end()) {
    absorb(std::move(carried->second), event);
    carried_.erase(carried);
  }
  waiting_.push_back(std::move(event));
  places_[waiting_.back().agent].push_back(std::prev(waiting_.end()));
}

void Courier::supersede_cycle(const Event& control) {
  std::vector<Waiting::iterator>& places = places_[control.agent];
  const auto old = std::ranges::find_if(
      places, [](const auto& place) { return place->cause() == Cause::kControl; });
  if (old == places.end()) return;
  ++losses_.missed_cycles;
  Event superseded = std::move(**old);
  waiting_.erase(*old);
  const auto next = places.erase(old);
  // The changes keep their order: they move to the agent's next waiting event, …
  if (next != places.end()) return absorb(std::move(superseded), **next);
  // … or to the next event that will be posted.
  const auto carried = carried_.find(control.agent);
  if (carried != carried_.end()) {
    absorb(std::move(superseded), carried->second);
  } else {
    carried_.emplace(control.agent, std::move(superseded));
  }
}

void Courier::lose(Event event) {
  ++losses_.overflow[{event.agent, event.cause()}];
  const auto [carried, is_first] = carried_.try_emplace(event.agent, event);
  if (is_first) return;
  absorb(std::move(carried->second), event);
  carried->second = std::move(event);
}

Result<Courier::Turn> Courier::attend() {
  Turn turn;
  if (under_way_) {
    Result<std::optional<Reply>> reply = port_->try_finish();
    if (!reply) return tl::unexpected(reply.error());
    if (*reply) take_in(std::move(**reply), turn);
  } else if (auto alive = port_->check_alive(); !alive) {
    return tl::unexpected(alive.error());
  }
  if (under_way_ || waiting_.empty()) return turn;
  if (auto begun = begin(turn); !begun) return tl::unexpected(begun.error());
  return turn;
}

Result<Courier::Turn> Courier::repeat(bool replied, bool began) {
  Turn turn;
  if (replied) {
    if (!under_way_) return fail(Errc::kProtocol, "the record answers a Step that never began");
    Result<Turn> finished = finish();
    if (!finished) return finished;
    turn = std::move(*finished);
  }
  if (!began) return turn;
  if (under_way_) return fail(Errc::kProtocol, "the record begins a Step before an answer");
  if (waiting_.empty()) return fail(Errc::kProtocol, "the record begins a Step without events");
  if (auto begun = begin(turn); !begun) return tl::unexpected(begun.error());
  return turn;
}

Result<Courier::Turn> Courier::finish() {
  Turn turn;
  if (!under_way_) return turn;
  Result<Reply> reply = port_->finish();
  if (!reply) return tl::unexpected(reply.error());
  take_in(std::move(*reply), turn);
  return turn;
}

Result<void> Courier::begin(Turn& turn) {
  BARAKA_CHECK(!under_way_);
  step_.sequence = ++sequence_;
  step_.events.assign(std::make_move_iterator(waiting_.begin()),
                      std::make_move_iterator(waiting_.end()));
  waiting_.clear();
  places_.clear();
  step_.until = step_.events.back().time;
  turn.began = under_way_ = true;
  return port_->begin(step_);
}

void Courier::take_in(Reply reply, Turn& turn) {
  under_way_ = false;
  turn.replied = true;
  turn.until = step_.until;
  for (const Event& event : step_.events) turn.answered.push_back(event.agent);
  std::ranges::sort(turn.answered);
  turn.answered.erase(std::unique(turn.answered.begin(), turn.answered.end()), turn.answered.end());
  for (Action& action : reply.actions) {
    BARAKA_CHECK(action.event < step_.events.size());  // the port guarantees it
    const Time event_time = step_.events[action.event].time;
    turn.answers.push_back({std::move(action), event_time});
  }
}

}  // namespace hal::node::exchange
