#pragma once

#include "hal/files/description/fields.h"
#include "results/campaign/campaign_file.h"

namespace results::campaign {

/// `vary`, `points` and `sample` of a campaign file: at most one of them.
void design_keys(hal::files::description::Fields& io, CampaignFile& campaign);

}  // namespace results::campaign
