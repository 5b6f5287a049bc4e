#pragma once

#include "hal/rtps/cursor.h"
#include "hal/rtps/fault.h"

namespace hal::rtps {

/// Reads a SequenceNumberSet (OMG DDSI-RTPS 2.5, 9.4.2.6): a base, numBits of 0 to 256 and as many
/// bits in words of 32.
/// @param least  that the base may be; 0 only where the standard's readers use it, see ACKNACK.
/// @param[out] base  of the set.
Objection read_sequence_number_set(Cursor& cursor, std::int64_t least, std::int64_t& base);

/// Reads a FragmentNumberSet (9.4.2.8): the same with a base of 32 bits, at least 1.
Objection read_fragment_number_set(Cursor& cursor);

}  // namespace hal::rtps
