#pragma once

#include "sim/agents/simulation.h"

namespace tests {

/// As fast as can be, to the end.
class NoPace final : public sim::agents::Pace {
 public:
  Verdict may_go_on(hal::Time, const sim::agents::Progress&) override { return Verdict::kGoOn; }
};

}  // namespace tests
