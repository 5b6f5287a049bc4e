#pragma once

#include <sys/uio.h>

#include <algorithm>
#include <cstddef>

namespace programs::waits {

inline std::size_t length_of(const iovec* parts, std::size_t count) {
  std::size_t length = 0;
  for (std::size_t i = 0; i < count; ++i) length += parts[i].iov_len;
  return length;
}

/// Its parts from a byte on. @param rest  as many. @return how many are left.
inline std::size_t parts_from(const iovec* parts, std::size_t count, std::size_t begin,
                              iovec* rest) {
  std::size_t left = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t skipped = std::min(begin, parts[i].iov_len);
    begin -= skipped;
    if (skipped == parts[i].iov_len) continue;
    rest[left++] = {static_cast<char*>(parts[i].iov_base) + skipped, parts[i].iov_len - skipped};
  }
  return left;
}

}  // namespace programs::waits
