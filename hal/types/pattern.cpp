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
  // From the ends: whether the rests one[i..] and other[k..] have a name in common, for all k.
  std::vector<char> next(other.size() + 1, 0);
  for (std::size_t i = one.size() + 1; i-- > 0;) {
    std::vector<char> rest(other.size() + 1, 0);
    const bool starts = i < one.size() && one[i] == '*';
    for (std::size_t k = other.size() + 1; k-- > 0;) {
      const bool is_end = i == one.size() && k == other.size();
      if (starts || (k < other.size() && other[k] == '*')) {
        // A star ends here, or takes what the other pattern begins with.
        rest[k] = static_cast<char>((i < one.size() && next[k] != 0) ||
                                    (k < other.size() && rest[k + 1] != 0));
      } else if (i < one.size() && k < other.size()) {
        const bool same = one[i] == other[k] || one[i] == '?' || other[k] == '?';
        rest[k] = static_cast<char>(same && next[k + 1] != 0);
      } else {
        rest[k] = static_cast<char>(is_end);
      }
    }
    next.swap(rest);
  }
  return next.front() != 0;
}

}  // namespace hal
