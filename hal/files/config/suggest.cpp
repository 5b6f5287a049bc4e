#include "hal/files/config/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace hal::files::config {
namespace {

/// Number of letters to insert, delete, replace or swap with the next one, with no letter edited
/// twice (optimal string alignment: F. J. Damerau, "A technique for computer detection and
/// correction of spelling errors", 1964, by the table of R. A. Wagner and M. J. Fischer, "The
/// String-to-String Correction Problem", 1974).
std::size_t distance(std::string_view a, std::string_view b) {
  // Rows i - 1, i and i + 1 of the table: entry j is the distance to the first j letters of b.
  std::vector<std::size_t> earlier(b.size() + 1), before(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::swap(earlier, before);
    std::swap(before, row);
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = before[j] + (a[i] == b[j] ? 0 : 1);
      row[j + 1] = std::min({replaced, row[j] + 1, before[j + 1] + 1});
      if (i == 0 || j == 0 || a[i] != b[j - 1] || a[i - 1] != b[j]) continue;
      row[j + 1] = std::min(row[j + 1], earlier[j - 1] + 1);
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

}  // namespace hal::files::config
