#pragma once

#include <boost/container/small_vector.hpp>
#include <cstddef>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"
#include "hal/types/verdict.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::radio {

/// A request that waits in a station: of its own client, or, in an access point, of another station
/// whose frame it relays.
struct WaitingMsdu {
  MacRequest request;  ///< Addressed to the final destination.
  hal::AgentId source;
  hal::Time since{};       ///< Time of arrival; the lifetime counts from it.
  bool over_wire = false;  ///< Sent to another access point over the distribution system.

  std::size_t bytes() const { return request.payload->size(); }
};

/// A request that a queue has dropped.
struct DroppedMsdu {
  WaitingMsdu waiting;
  hal::Verdict verdict;
};
using DroppedMsdus = boost::container::small_vector<DroppedMsdu, 1>;

}  // namespace sim::radio
