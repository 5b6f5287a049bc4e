#pragma once

#include "hal/files/description/fields.h"
#include "results/campaign/campaign_file.h"

namespace results::campaign {

/// The keys `vary`, `points` and `sample` of a campaign file. At most one of them may be given.
void design_keys(hal::files::description::Fields& io, CampaignFile& campaign);

}  // namespace results::campaign
