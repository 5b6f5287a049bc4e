#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace baraka::run::output {

/// A finished result, which another run of the same scenario and seed would only repeat.
struct FinishedResult {
  int status = 0;  ///< Exit status of the run: kDone or kExpectationNotMet.
  std::string result, fingerprint, frames_digest;
};

/// The finished result in a folder. None: the folder has no result, or one with another seed, or
/// one of a run that failed or was cut short.
/// @param seed  that the result must have; none: any.
/// @pre No run is writing there: on a shared file system, a database that another computer is
///   writing cannot be read.
std::optional<FinishedResult> finished_result(const std::filesystem::path& folder,
                                              std::optional<std::uint64_t> seed = {});

/// Refuses a finished result of another scenario. Keys on which only the report depends may differ.
/// @param resolved  the requested scenario, from sim::scenario::resolved_yaml().
/// @param until  as in the table `settings`.
/// @throws UsageError  the result is of another scenario; names the first difference.
void require_result_of(const std::filesystem::path& folder, const std::string& resolved,
                       const std::string& until);

}  // namespace baraka::run::output
