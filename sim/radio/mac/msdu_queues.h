#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/agent_id.h"
#include "sim/radio/mac/channel_access.h"
#include "sim/radio/mac/observer.h"
#include "sim/radio/mac/queue_discipline.h"
#include "sim/radio/mac/station_schedule.h"
#include "sim/radio/mac/tx_queue.h"

namespace sim::radio {

/// Whose MSDUs wait in MsduQueues: makes frames of them when it is their turn.
class MsduQueueClient {
 public:
  virtual ~MsduQueueClient() = default;
  /// Whether data may be sent now.
  virtual bool is_open() const { return true; }
  /// Name of the queue for a receiver: by default the receiver's.
  virtual hal::AgentId queue_for(hal::AgentId receiver) const { return receiver; }
  /// Makes the frame. @return nullopt: it takes another path, which this call has started.
  virtual std::optional<MacRequest> on_turn(WaitingMsdu waiting) = 0;
  /// The MSDU ends; to be reported in a later event.
  virtual void on_dropped(WaitingMsdu waiting, hal::Verdict verdict) = 0;
};

/// The queues of a station's data, one for each receiver and access category, from which MSDUs go
/// only when they are about to be sent: those of mac80211's software queues.
class MsduQueues {
 public:
  struct Name {
    ContentionFunction function = 0;
    hal::AgentId receiver{};
    auto operator<=>(const Name&) const = default;
  };

  struct Station {
    RadioObserver& observer;
    hal::AgentId agent;
    std::uint64_t seed;  ///< Of flow_hash().
  };
  /// @param config  outlives this object, as does the observer.
  MsduQueues(const DcfConfig& config, std::size_t functions, const Station& station);

  /// @pre called before anything is pushed; the client outlives this object.
  void set_client(MsduQueueClient& client) { client_ = &client; }
  MsduQueueClient& client() const { return *client_; }
  /// @return false: the queue has no room.
  bool push(const Name& name, WaitingMsdu msdu, hal::Time now);
  /// The frame that goes next from a queue. @return nullopt: there is none.
  std::optional<Outgoing> pop(const Name& name, hal::Time now);
  /// Takes back a frame that was popped, before all others.
  void put_back(const Name& name, Outgoing outgoing);

  bool has(const Name& name) const;
  /// Whether anything waits for this function, and may be sent.
  bool has(ContentionFunction function) const {
    const Count& count = counts_[function];
    return count.back > 0 || (count.waiting > 0 && client_->is_open());
  }
  StationSchedule& schedule(ContentionFunction function) { return schedules_[function]; }

  /// Number of MSDUs in the queues, and of those with what was put back.
  std::size_t waiting() const;
  std::size_t waiting_with_back() const;
  /// How many more MSDUs the fullest queue of a function takes.
  std::size_t room(ContentionFunction function) const;
  /// Removes everything: the radio is switched off. @param back  gets what was put back.
  void clear(hal::Time now, std::vector<Outgoing>& back);

 private:
  struct Queue {
    std::unique_ptr<QueueDiscipline> discipline;
    std::deque<Outgoing> back;  ///< What was put back.
  };
  Queue& queue(const Name& name);
  void expire(const Name& name, Queue& queue, hal::Time now, DroppedMsdus& dropped);
  void report(const Name& name, hal::Time now, const DroppedMsdus& dropped);
  void tell(const Name& name, hal::Time now, const WaitingMsdu& msdu, QueueChange::What what,
            hal::Verdict verdict = hal::Verdict::kDelivered);
  std::optional<WaitingMsdu> take(const Name& name, Queue& queue, hal::Time now);

  const DcfConfig& config_;
  QueueLimits limits_;
  Station station_;
  MsduQueueClient* client_ = nullptr;
  std::vector<StationSchedule> schedules_;
  struct Count {
    std::size_t waiting = 0, back = 0;
  };
  std::vector<Count> counts_;  ///< Of each function.
  std::map<Name, Queue> queues_;
};

}  // namespace sim::radio
