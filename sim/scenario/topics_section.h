#pragma once

#include "sim/scenario/fields.h"
#include "sim/scenario/scenario.h"

namespace sim::scenario {

/// `dds:` and `topics:` of a group whose agents have a network.
void topics_keys(Fields& io, Group& group);

/// Notes readers that are no agents with a network, and gives each group whose agents write or read
/// topics the program that plays them. @param in  the top level.
void find_topics(Mapping& in, Scenario& scenario);

}  // namespace sim::scenario
