#pragma once

#include <cstdint>
#include <vector>

#include "results/campaign/campaign_file.h"

namespace results::campaign {

/// Latin hypercube sampling (M. D. McKay, R. J. Beckman, W. J. Conover, "A Comparison of Three
/// Methods for Selecting Values of Input Variables in the Analysis of Output from a Computer Code",
/// Technometrics 21(2), 1979): each range is divided into `samples` parts of equal probability, one
/// value is drawn at random from each part, and the parts of different ranges are paired at random.
/// Each range has its own random stream, named after its key, so adding a range does not change the
/// values of the others. Values have six significant digits.
/// @param seed  of the campaign.
std::vector<DesignPoint> latin_hypercube(const std::vector<SampledRange>& ranges, int samples,
                                         std::uint64_t seed);

/// The points of a campaign of any design. @param seed  of the campaign.
/// @throws hal::files::config::ConfigErrors  two of the drawn points are equal.
std::vector<DesignPoint> points_of(const CampaignFile& campaign, std::uint64_t seed);

}  // namespace results::campaign
