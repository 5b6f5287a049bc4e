#include "hal/config/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hal::config {
namespace {

/// Number of letters to insert, delete or replace (R. A. Wagner, M. J. Fischer, "The
/// String-to-String Correction Problem", 1974).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

std::optional<std::size_t> nearest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  std::optional<std::size_t> best;
  std::size_t least = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const std::size_t letters = distance(word, candidates[i]);
    if (3 * letters > std::max(word.size(), candidates[i].size())) continue;
    if (!best || letters < least) {
      best = i;
      least = letters;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const auto best = nearest(word, candidates);
  return best ? fmt::format("; did you mean '{}'?", candidates[*best]) : "";
}

}  // namespace hal::config
