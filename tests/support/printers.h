#pragma once

#include <ostream>

#include "hal/types/agent_id.h"
#include "hal/types/time.h"

/// How GoogleTest prints our types when a check fails.
namespace hal {

inline void PrintTo(AgentId id, std::ostream* out) { *out << "agent " << id.value; }

}  // namespace hal

namespace std::chrono {

inline void PrintTo(hal::Duration d, std::ostream* out) { *out << d.count() << " ns"; }
inline void PrintTo(hal::Time t, std::ostream* out) { *out << hal::to_ns(t) << " ns"; }

}  // namespace std::chrono
