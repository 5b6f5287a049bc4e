#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>

#include "gateway/guard/fastdds.h"

namespace gateway::guard {

/// Room that a sample gets at first, bytes; it grows with the samples, which needs the memory
/// policy PREALLOCATED_WITH_REALLOC of all writers and readers here.
constexpr std::uint32_t kFirstRoom = 1024;

/// A type whose samples are dropped if they cannot be decoded. The generated code does not catch
/// exceptions of Fast CDR, for example for a boolean that is neither 0 nor 1, which on a thread of
/// DDS would end the program.
/// @tparam PubSub  generated for the type.
template <class PubSub>
class GuardedType final : public PubSub {
 public:
  /// Of a sequence without bounds the generated code assumes 100 elements, and so on within each of
  /// them: megabytes, which Fast DDS would fill with zeros for every writer and reader.
  GuardedType() {
    if (!this->is_bounded()) this->m_typeSize = std::min(this->m_typeSize, kFirstRoom);
  }

  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return PubSub::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

}  // namespace gateway::guard
