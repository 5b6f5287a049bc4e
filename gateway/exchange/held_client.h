#pragma once

#include <memory>

#include "gateway/exchange/client_end.h"

namespace gateway::exchange {

/// A client of a process that is held in lock-step: it exchanges over a HeldChannel that it has
/// inherited, without threads and without time-outs of its own. Null: there is none.
/// @throws std::runtime_error  the channel does not exist, or is at its end.
std::unique_ptr<ClientEnd> make_held_client(hal::node::exchange::Hello hello);

}  // namespace gateway::exchange
