#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hal::files::config {

/// The index of the candidate that is nearest to `word`, or nothing when none is near: at most a
/// third of the letters are inserted, deleted, replaced or swapped with the next one, two swapped
/// letters counting as one edit. Ties: the first candidate.
std::optional<std::size_t> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates);

/// "; did you mean 'cca_threshold'?" for the nearest() candidate; nothing if there is none.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace hal::files::config
