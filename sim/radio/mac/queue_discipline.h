#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>

#include "sim/radio/mac/queues_config.h"
#include "sim/radio/mac/waiting_msdu.h"

namespace sim::radio {

/// What a queue may hold.
struct QueueLimits {
  std::size_t frames = 0;
  std::size_t bytes = std::numeric_limits<std::size_t>::max();
};

/// Order in which MSDUs leave a queue, and which ones are dropped.
class QueueDiscipline {
 public:
  virtual ~QueueDiscipline() = default;
  /// Whether push() takes the MSDU.
  virtual bool accepts(const WaitingMsdu& msdu) const = 0;
  /// @param dropped  gets what is dropped to keep the limits. @pre accepts the MSDU.
  virtual void push(WaitingMsdu msdu, DroppedMsdus& dropped) = 0;
  /// Takes out the next one. @return nullopt if there is none, or all have been dropped.
  virtual std::optional<WaitingMsdu> pop(hal::Time now, DroppedMsdus& dropped) = 0;
  /// Drops what arrived before a time (kExpired).
  virtual void expire(hal::Time before, DroppedMsdus& dropped) = 0;
  virtual std::size_t frames() const = 0;
  virtual std::size_t bytes() const = 0;  ///< Of payload.
};

/// @param seed  of the hash that tells flows apart.
std::unique_ptr<QueueDiscipline> make_discipline(const QueuesConfig& config,
                                                 const QueueLimits& limits, std::uint64_t seed);

/// MSDUs, first in, first out.
class FlowQueue {
 public:
  bool is_empty() const { return queue_.empty(); }
  std::size_t frames() const { return queue_.size(); }
  std::size_t bytes() const { return bytes_; }
  void push(WaitingMsdu msdu);
  std::optional<WaitingMsdu> pop();
  /// Takes out what arrived before a time; it is the first.
  void expire(hal::Time before, DroppedMsdus& dropped);

 private:
  std::deque<WaitingMsdu> queue_;
  std::size_t bytes_ = 0;
};

/// First in, first out; what does not fit is not accepted.
class FifoQueue final : public QueueDiscipline {
 public:
  explicit FifoQueue(const QueueLimits& limits) : limits_(limits) {}

  bool accepts(const WaitingMsdu& msdu) const override {
    return queue_.frames() < limits_.frames && msdu.bytes() <= limits_.bytes - queue_.bytes();
  }
  void push(WaitingMsdu msdu, DroppedMsdus& dropped) override;
  std::optional<WaitingMsdu> pop(hal::Time now, DroppedMsdus& dropped) override;
  void expire(hal::Time before, DroppedMsdus& dropped) override;
  std::size_t frames() const override { return queue_.frames(); }
  std::size_t bytes() const override { return queue_.bytes(); }

 private:
  QueueLimits limits_;
  FlowQueue queue_;
};

}  // namespace sim::radio
