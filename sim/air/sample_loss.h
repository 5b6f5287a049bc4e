#pragma once

#include <compare>
#include <cstdint>
#include <string_view>

#include "hal/types/agent_id.h"
#include "hal/types/verdict.h"

namespace sim::air {

/// Cause and place of the loss of a sample on its way to an agent.
struct LossCause {
  enum class Kind : std::uint8_t {
    kUnknown,     ///< No loss of a frame that carried it was observed.
    kNotMatched,  ///< It was received before its writer's announcement, and therefore dropped.
    kVerdict,     ///< The frame or message that carried it ended with `verdict`.
  };
  Kind kind = Kind::kUnknown;
  hal::Verdict verdict = hal::Verdict::kDelivered;  ///< For kVerdict.
  /// Agent whose frame or queue it was: the writer's agent or an access point. The receiver for
  /// kNotMatched, and for "no route" if it was not associated with an access point. 0 for kUnknown.
  hal::AgentId at{};
  auto operator<=>(const LossCause&) const = default;
};

/// "collision", …; "not matched", "unknown".
constexpr std::string_view name(LossCause::Kind kind) {
  return kind == LossCause::Kind::kNotMatched ? "not matched" : "unknown";
}
inline std::string_view name(const LossCause& cause) {
  return cause.kind == LossCause::Kind::kVerdict ? hal::name(cause.verdict) : name(cause.kind);
}

/// A cause and the id of the lost frame; 0 if no frame was sent.
struct SampleLoss {
  LossCause cause;
  std::uint64_t frame = 0;
};

}  // namespace sim::air
