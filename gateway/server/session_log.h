#pragma once

#include <string>

#include "hal/node/exchange/session.h"
#include "hal/types/log.h"
#include "hal/types/time.h"

namespace gateway::server {

/// A line of the log, from the gateway.
void log(hal::log::Level level, hal::Time at, const std::string& text);

/// For debugging: a Hello that was received, and a Session that was granted.
void log_hello(const hal::node::exchange::Hello& hello, hal::Time at);
void log_session(const hal::node::exchange::Hello& hello,
                 const hal::node::exchange::Session& session);

}  // namespace gateway::server
