#pragma once

#include "sim/agents/condition.h"
#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// Example of a condition, for the descriptions of keys that take one.
inline constexpr std::string_view kConditionExample = "{any: 'NAME*', state: FULFILLED}";

/// The keys of a condition; reading adds the states that it uses to `scenario.awaited`.
/// @param scenario  with its agents.
void keys_of(Fields& io, agents::Condition& condition, Scenario& scenario);

/// Reads a condition and adds the states that it uses to `scenario.awaited`.
/// @param scenario  with its agents.
agents::Condition read_condition(Mapping in, Scenario& scenario);

/// Writes a condition into an open mapping.
void write_condition(Writer& out, agents::Condition condition, const Scenario& scenario);

}  // namespace sim::scenario
