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
    kNotMatched,  ///< It arrived before the announcement of its writer, and was dropped.
    kVerdict,     ///< The frame or message that carried it ended with `verdict`.
  };
  Kind kind = Kind::kUnknown;
  hal::Verdict verdict = hal::Verdict::kDelivered;  ///< Of kVerdict.
  /// Whose frame or queue it was: the writer's agent or an access point; the receiver of
  /// kNotMatched, and of "no route" if it was with no access point; of kUnknown 0.
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

/// That, and the frame that it was; 0: it was in none.
struct SampleLoss {
  LossCause cause;
  std::uint64_t frame = 0;
};

}  // namespace sim::air
