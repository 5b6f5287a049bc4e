#pragma once

#include "sim/agents/condition.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// What the value of a key that takes a condition looks like, for its description.
inline constexpr std::string_view kConditionExample = "{any: 'NAME*', state: FULFILLED}";

/// A condition; reading notes the states that it asks about in `scenario.awaited`.
/// @param scenario  with its agents.
void keys_of(Fields& io, agents::Condition& condition, Scenario& scenario);

/// Reads a condition; notes the states that it asks about in `scenario.awaited`.
/// @param scenario  with its agents.
agents::Condition read_condition(Mapping in, Scenario& scenario);

/// Into a mapping that is open.
void write_condition(Writer& out, agents::Condition condition, const Scenario& scenario);

}  // namespace sim::scenario
