#pragma once

#include "hal/config/mapping.h"
#include "sim/campaign/campaign_file.h"

namespace sim::campaign {

/// `vary`, `points` and `sample` of a campaign file: at most one of them.
void read_design(hal::config::Mapping& in, CampaignFile& campaign);

}  // namespace sim::campaign
