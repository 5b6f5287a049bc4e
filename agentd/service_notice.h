#pragma once

#include <optional>
#include <string_view>

#include "hal/types/time.h"

namespace agentd {

/// Tells the service manager that started this process how it is, by the protocol of sd_notify(3):
/// "READY=1", "STOPPING=1", "WATCHDOG=1". Without a service manager: no effect.
void notify_service_manager(std::string_view state);

/// How often it wants to hear "WATCHDOG=1": half of WATCHDOG_USEC. None: it does not watch.
std::optional<hal::Duration> watchdog_period();

}  // namespace agentd
