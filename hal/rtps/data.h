#pragma once

#include <cstdint>

#include "hal/rtps/fault.h"
#include "hal/rtps/limits.h"
#include "hal/rtps/submessage.h"

namespace hal::rtps {

/// The contents of a DATA or DATA_FRAG (OMG DDSI-RTPS 2.5, 9.4.5.3 and 9.4.5.4).
struct Data {
  EntityId reader, writer;
  std::int64_t sequence_number = 0;
  Octets payload;  ///< With its encapsulation; in a DATA_FRAG a part of it. May be empty.
  bool is_key = false;
  /// StatusInfo_t of its inline QoS (9.6.3.9): 1 disposed, 2 unregistered.
  std::uint32_t status = 0;
  std::uint32_t first_fragment = 0, fragments = 0, fragment_size = 0;  ///< 0 in DATA.
  std::uint32_t sample_size = 0;                                       ///< 0 in DATA.
};

/// Reads and checks a DATA or DATA_FRAG: sequence number, fragments, bounds of inline QoS and
/// payload, and the contents of discovery.
/// @param source  participant of the writer.
/// @param[out] data  the values read; complete if there is no objection.
Objection judge_data(const Submessage& submessage, const GuidPrefix& source, const Limits& limits,
                     Data& data);

}  // namespace hal::rtps
