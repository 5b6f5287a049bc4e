#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hal::files::config {

/// The index of the candidate nearest to `word`, or nullopt if none is near: at most a third of the
/// letters are inserted, deleted, replaced or swapped with the next one, where a swap counts as one
/// edit. Ties go to the first candidate.
std::optional<std::size_t> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// "; did you mean 'cca_threshold'?" for the nearest() candidate; empty if there is none.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace hal::files::config
