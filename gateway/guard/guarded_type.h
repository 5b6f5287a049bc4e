#pragma once

#include <exception>

#include "gateway/guard/fastdds.h"

namespace gateway::guard {

/// A type whose samples are dropped if they cannot be decoded. The generated code does not catch
/// exceptions of Fast CDR, for example for a boolean that is neither 0 nor 1, which on a thread of
/// DDS would end the program.
/// @tparam PubSub  generated for the type.
template <class PubSub>
class GuardedType final : public PubSub {
 public:
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    try {
      return PubSub::deserialize(payload, data);
    } catch (const std::exception&) {
      return false;
    }
  }
};

}  // namespace gateway::guard
