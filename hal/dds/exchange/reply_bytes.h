#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hal/exchange/step.h"
#include "hal/types/result.h"

namespace hal::dds {

/// A Reply as it travels, for a record of what came from a process. @pre it fits into memory twice.
std::vector<std::uint8_t> bytes_of(const exchange::Reply& reply);

/// And back, every value bit by bit. Errors: kProtocol (they are of no Reply).
Result<exchange::Reply> reply_of(std::span<const std::uint8_t> bytes);

}  // namespace hal::dds
