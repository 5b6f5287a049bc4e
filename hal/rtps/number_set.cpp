#include "hal/rtps/number_set.h"

#include <limits>

namespace hal::rtps {
namespace {

constexpr std::uint32_t kMostBits = 256;

Objection read_bits(Cursor& cursor) {
  const std::uint32_t bits = cursor.u32();
  if (bits > kMostBits) return "a set of numbers has more than 256 bits";
  cursor.take(std::size_t{(bits + 31) / 32} * 4);
  return cursor.is_short() ? "a set of numbers is cut off" : Objection{};
}

}  // namespace

Objection read_sequence_number_set(Cursor& cursor, std::int64_t least, std::int64_t& base) {
  base = cursor.sequence_number();
  if (base < least) return "a set of sequence numbers begins too low";
  if (base > std::numeric_limits<std::int64_t>::max() - kMostBits) {
    return "a set of sequence numbers goes beyond the last one there is";
  }
  return read_bits(cursor);
}

Objection read_fragment_number_set(Cursor& cursor) {
  const std::uint32_t base = cursor.u32();
  if (base == 0) return "a set of fragment numbers begins with 0";
  if (base > std::numeric_limits<std::uint32_t>::max() - kMostBits) {
    return "a set of fragment numbers goes beyond the last one there is";
  }
  return read_bits(cursor);
}

}  // namespace hal::rtps
