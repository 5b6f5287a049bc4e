#pragma once

#include <exception>

#include "hal/dds/fastdds.h"

namespace hal::dds {

/// A type whose samples are dropped if they cannot be decoded. The generated code lets through what
/// Fast CDR throws, for a boolean that is neither 0 nor 1 for example, and on a thread of DDS that
/// would be the end of the program.
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

}  // namespace hal::dds
