#include "hal/types/pattern.h"

#include <cstddef>
#include <vector>

namespace hal {

bool matches(std::string_view pattern, std::string_view name) {
  // The last star, and the end of the characters that it matches so far: on a mismatch it takes one
  // more.
  std::size_t star = std::string_view::npos;
  std::size_t taken = 0;
  std::size_t p = 0;
  std::size_t n = 0;
  while (n < name.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n]) && pattern[p] != '*') {
      ++p;
      ++n;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

bool overlap(std::string_view one, std::string_view other) {
  const auto is_star = [](std::string_view of, std::size_t at) {
    return at < of.size() && of[at] == '*';
  };
  const auto meet = [](char a, char b) { return a == b || a == '?' || b == '?'; };
  // From the ends: rest[k] is whether one[i..] and other[k..] have a name in common, next[k] the
  // same of one[i + 1..].
  std::vector<bool> next(other.size() + 1, false);
  for (std::size_t i = one.size() + 1; i-- > 0;) {
    std::vector<bool> rest(other.size() + 1, false);
    rest.back() = i == one.size() || (is_star(one, i) && next.back());
    for (std::size_t k = other.size(); k-- > 0;) {
      if (is_star(one, i) || is_star(other, k)) {
        // A star ends here, or takes what the other pattern begins with.
        rest[k] = next[k] || rest[k + 1];
      } else {
        rest[k] = i < one.size() && meet(one[i], other[k]) && next[k + 1];
      }
    }
    next.swap(rest);
  }
  return next.front();
}

}  // namespace hal
