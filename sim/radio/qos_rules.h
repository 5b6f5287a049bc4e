#pragma once

#include <optional>

#include "sim/radio/radio_config.h"
#include "sim/radio/rule_list.h"

namespace sim::radio {

/// What must hold of contention windows, EDCA, queues, modes with MCSs, and aggregation.
void ask_window(Rules& rules, std::string_view key, std::uint32_t window);
void ask_edca(Rules& rules, const EdcaConfig& edca);
/// Of what access points announce, if anything.
void ask_announced_edca(Rules& rules, const std::optional<EdcaConfig>& edca);
void ask_queues(Rules& rules, const QueuesConfig& queues);
void ask_mcs(Rules& rules, const HtConfig& config);
void ask_aggregation(Rules& rules, const HtConfig& config);

}  // namespace sim::radio
