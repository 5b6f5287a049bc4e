#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace baraka::run::output {

/// A result that another run of the same scenario and seed would only repeat.
struct FinishedResult {
  int status = 0;  ///< Exit status of the run: kDone or kExpectationNotMet.
  std::string result, fingerprint;
};

/// None: there is no result in the folder, of another seed (none: of any), or of a run that failed
/// or was cut short. @pre no run is writing there: on a file system of several computers, a
/// database that is being written elsewhere cannot be read.
std::optional<FinishedResult> finished_result(const std::filesystem::path& folder,
                                              std::optional<std::uint64_t> seed = {});

/// @param resolved  scenario that is asked for, as of sim::scenario::resolved_yaml().
/// @param until  as in the table settings.
/// @throws UsageError  the finished result in the folder is of another one, with the first
///   difference; what only a report depends on may differ.
void require_result_of(const std::filesystem::path& folder, const std::string& resolved,
                       const std::string& until);

}  // namespace baraka::run::output
