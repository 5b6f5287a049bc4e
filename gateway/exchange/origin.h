#pragma once

#include <cstddef>
#include <cstring>
#include <string>

#include "gateway/guard/fastdds.h"
#include "hal/rtps/entity_id.h"

namespace gateway::exchange {

/// The writer that a sample came from: its GUID.
using Origin = guard::rtps::InstanceHandle_t;

/// The participant of a writer.
inline hal::rtps::GuidPrefix participant_of(const Origin& origin) {
  hal::rtps::GuidPrefix prefix;
  for (std::size_t i = 0; i < prefix.octets.size(); ++i) {
    prefix.octets[i] = std::byte{origin.value[i]};
  }
  return prefix;
}

/// 24 hexadecimal digits as tools print them: "010f5f9d24b2…".
std::string text_of(const hal::rtps::GuidPrefix& participant);

}  // namespace gateway::exchange
