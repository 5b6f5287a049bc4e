#pragma once

#include <optional>
#include <string_view>

#include "hal/types/time.h"

namespace agentd {

/// Reports a state to the service manager that started this process, by the protocol of
/// sd_notify(3): "READY=1", "STOPPING=1", "WATCHDOG=1". No effect without a service manager.
void notify_service_manager(std::string_view state);

/// Period in which the service manager expects "WATCHDOG=1": half of WATCHDOG_USEC. None: it does
/// not watch.
std::optional<hal::Duration> watchdog_period();

}  // namespace agentd
