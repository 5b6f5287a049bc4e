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

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  std::size_t least = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t letters = distance(word, candidate);
    if (3 * letters > std::max(word.size(), candidate.size())) continue;
    if (best == nullptr || letters < least) {
      best = &candidate;
      least = letters;
    }
  }
  return best == nullptr ? "" : fmt::format("; did you mean '{}'?", *best);
}

}  // namespace hal::config
