#pragma once

#include <nlohmann/json.hpp>

#include "results/report/group.h"

namespace results::report {

/// For the report as a page, over all runs of a group: what access points passed on, and the queues
/// for receivers and access categories.
nlohmann::ordered_json relays_json(const Group& group);
nlohmann::ordered_json queues_json(const Group& group);

}  // namespace results::report
