#pragma once

#include "hal/files/config/mapping.h"
#include "results/campaign/campaign_file.h"

namespace results::campaign {

/// `vary`, `points` and `sample` of a campaign file: at most one of them.
void read_design(hal::files::config::Mapping& in, CampaignFile& campaign);

}  // namespace results::campaign
