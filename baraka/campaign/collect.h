#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "baraka/campaign/campaign_folder.h"
#include "baraka/campaign/engine.h"
#include "results/campaign/rows.h"

namespace baraka::campaign {

/// A run that has ended: its row of the database and its measurements.
struct CollectedRun {
  results::campaign::RunRow row;
  results::campaign::Measured measured;
};

/// Reads a run's result. @return none: there is no result, it has another seed, or it is not
/// complete, that is it records neither a successful end nor an expectation that was not met.
std::optional<CollectedRun> collect_finished(const CampaignFolder& folder,
                                             const results::campaign::RunPlan& run);

/// Reads the result of a run whose process has ended. Without a complete result the run is a failed
/// one, with the reason.
CollectedRun collect(const CampaignFolder& folder, const results::campaign::RunPlan& run,
                     const TaskEnd& end);

/// Turns a run into a failed one without measurements.
void fail(CollectedRun& collected, const std::string& error);

/// The disk is full, which makes runs fail for no fault of their own.
struct DiskFull : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// @param error  error message of a failed run.
/// @throws DiskFull  the message says so, or the campaign's folder has no room for another run to
///   begin.
void require_room(const CampaignFolder& folder, const std::string& error);

/// The current time: "2026-11-22T20:31:14Z".
std::string utc_now();

}  // namespace baraka::campaign
