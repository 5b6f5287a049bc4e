#pragma once

#include <cstdint>
#include <optional>

#include "hal/types/time.h"

namespace sim::radio {

/// What has a queue of its own at a station.
enum class QueuePer : std::uint8_t {
  kRadio,  ///< The station: one queue of ContentionConfig::queue_limit frames, first in, first out.
  kStation,  ///< Each receiver and access category.
};

enum class Discipline : std::uint8_t { kFifo, kFqCodel };

/// CoDel and its flows (IETF RFC 8289 and RFC 8290).
struct FqCodelConfig {
  hal::Duration target{5'000'000};      ///< Time in the queue that is accepted for long, > 0.
  hal::Duration interval{100'000'000};  ///< "Long", > target: the longest usual round trip.
  std::uint32_t quantum = 300;          ///< Bytes of a flow's turn, >= 1; as in mac80211.
  std::uint32_t flows = 1024;           ///< Number of flow queues, >= 1.
};

/// Queues of the data that wait for a DCF.
struct QueuesConfig {
  QueuePer per = QueuePer::kRadio;
  Discipline discipline = Discipline::kFifo;   ///< kRadio: kFifo.
  std::optional<std::uint32_t> limit{};        ///< Frames in each queue; nullopt: queue_limit.
  std::optional<std::uint32_t> limit_bytes{};  ///< Bytes of payload in each queue.
  FqCodelConfig fq_codel{};
  /// Receivers of a category share airtime rather than turns; kStation only.
  bool airtime_fairness = false;
  hal::Duration airtime_quantum{300'000};  ///< Airtime of a receiver's turn, > 0.
};

}  // namespace sim::radio
