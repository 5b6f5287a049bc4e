#pragma once

#include "hal/rtps/cursor.h"
#include "hal/rtps/fault.h"

namespace hal::rtps {

/// Reads a SequenceNumberSet (OMG DDSI-RTPS 2.5, 9.4.2.6): a base, numBits of 0 to 256 and that
/// number of bits in 32-bit words.
/// @param least  lowest permitted base; 0 only where the standard's readers use it, see ACKNACK.
/// @param[out] base  base of the set.
Objection read_sequence_number_set(Cursor& cursor, std::int64_t least, std::int64_t& base);

/// Reads a FragmentNumberSet (9.4.2.8): the same with a 32-bit base of at least 1.
Objection read_fragment_number_set(Cursor& cursor);

}  // namespace hal::rtps
