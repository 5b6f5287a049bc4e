#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace gateway::exchange {

/// A Reply as it travels, for a record of what came from a process. @pre it fits into memory twice.
std::vector<std::uint8_t> bytes_of(const hal::node::exchange::Reply& reply);

/// And back, every value bit by bit. Errors: kProtocol (they are of no Reply).
hal::Result<hal::node::exchange::Reply> reply_of(std::span<const std::uint8_t> bytes);

}  // namespace gateway::exchange
