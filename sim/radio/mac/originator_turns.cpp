// Whose turn it is at an originator with queues of receivers.
#include <algorithm>
#include <utility>

#include "sim/radio/mac/originator.h"

namespace sim::radio {

MsduQueues::Name Originator::name_of(ContentionFunction function, hal::AgentId receiver) const {
  return {function, queues_->client().queue_for(receiver)};
}

/// The stream with MPDUs in flight to the receivers of a queue; null if there is none.
MpduStream* Originator::stream_for(const Function& function, hal::AgentId queue) const {
  const auto found = std::ranges::find_if(function.streams, [&](const MpduStream* stream) {
    return queues_->client().queue_for(stream->to) == queue;
  });
  return found == function.streams.end() ? nullptr : *found;
}

std::optional<Exchange> Originator::next_turn(ContentionFunction number, hal::Time now,
                                              const Budget& budget, EndedMsdus& ended) {
  Function& function = functions_[number];
  StationSchedule& schedule = queues_->schedule(number);
  for (const MpduStream* const stream : function.streams) {
    schedule.add(queues_->client().queue_for(stream->to));
  }
  const auto has_work = [&](hal::AgentId queue) {
    return stream_for(function, queue) != nullptr || queues_->has({number, queue});
  };
  while (const std::optional<hal::AgentId> queue = schedule.next(has_work)) {
    if (MpduStream* const stream = stream_for(function, *queue)) {
      if (!resume(number, *stream, now, ended)) continue;
      std::erase(function.streams, stream);
      function.streams.push_front(stream);
      return stream_turn(number, *stream, now, budget);
    }
    std::optional<Outgoing> next = queues_->pop({number, *queue}, now);
    if (!next) continue;
    function.queue.put(std::move(*next), now);
    discard_expired(function, now, ended);
    if (!function.queue.is_empty()) return head_turn(number, now, budget);
  }
  return std::nullopt;
}

/// Moves the next MSDU of a receiver to the end of the queue. @return whether it is of the stream.
bool Originator::pop_more(ContentionFunction number, const MpduStream& stream, hal::Time now) {
  const MsduQueues::Name name = name_of(number, stream.to);
  std::optional<Outgoing> next = queues_->pop(name, now);
  if (!next) return false;
  const MacRequest& request = next->request;
  if (request.destination != stream.to || request.priority != stream.tid) {
    queues_->put_back(name, std::move(*next));
    return false;
  }
  functions_[number].queue.put(std::move(*next), now);
  return true;
}

/// What did not fit into the PPDU waits for the next turn of its receiver.
void Originator::put_back(ContentionFunction number, hal::Time now) {
  TxQueue& queue = functions_[number].queue;
  for (std::size_t place = queue.size(); place > 0; --place) {
    if (queue.at(place - 1).is_management()) continue;
    Outgoing left = queue.take(place - 1, now);
    const MsduQueues::Name name = name_of(number, left.request.destination);
    queues_->put_back(name, std::move(left));
  }
}

void Originator::charge(const Exchange& exchange) {
  if (queues_ == nullptr) return;
  const hal::AgentId queue = queues_->client().queue_for(exchange.to);
  queues_->schedule(exchange.function).charge(queue, exchange.mode->airtime(exchange.bits));
}

void Originator::charge(hal::AgentId sender, ContentionFunction function, hal::Duration airtime) {
  if (queues_ == nullptr || !queues_->schedule(function).is_of_airtime()) return;
  queues_->schedule(function).charge(queues_->client().queue_for(sender), airtime);
}

}  // namespace sim::radio
