#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "baraka/campaign/campaign_folder.h"
#include "baraka/campaign/engine.h"
#include "results/campaign/rows.h"

namespace baraka::campaign {

/// A run that has ended: a row of the database, and what it measured.
struct CollectedRun {
  results::campaign::RunRow row;
  results::campaign::Measured measured;
};

/// Reads a run's result. @return none: it is not there, of another seed, or was cut short: by its
/// own account it ended neither well nor with an expectation that was not met.
std::optional<CollectedRun> collect_finished(const CampaignFolder& folder,
                                             const results::campaign::RunPlan& run);

/// A run whose process has ended: as its result tells, else failed, with the reason.
CollectedRun collect(const CampaignFolder& folder, const results::campaign::RunPlan& run,
                     const TaskEnd& end);

/// Makes a run a failed one that has measured nothing.
void fail(CollectedRun& collected, const std::string& error);

/// The disk is full: then runs fail that would not fail otherwise.
struct DiskFull : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param error  of a run that failed.
/// @throws DiskFull  the run says so, or the campaign's folder takes no more than a run needs to
///   begin.
void require_room(const CampaignFolder& folder, const std::string& error);

/// Of now: "2026-11-22T20:31:14Z".
std::string utc_now();

}  // namespace baraka::campaign
