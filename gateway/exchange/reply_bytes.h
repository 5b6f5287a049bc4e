#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/node/exchange/step.h"
#include "hal/types/result.h"

namespace gateway::exchange {

/// Serialises a Reply as it is sent, to record what came from a process. @pre memory for two
/// copies.
std::vector<std::uint8_t> bytes_of(const hal::node::exchange::Reply& reply);

/// The reverse; every value is preserved bit by bit. Errors: kProtocol (the bytes are not a Reply).
hal::Result<hal::node::exchange::Reply> reply_of(std::span<const std::uint8_t> bytes);

}  // namespace gateway::exchange
