#pragma once

#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"
#include "hal/rtps/fault.h"
#include "hal/rtps/parameter_list.h"

namespace hal::rtps {

/// Whether the samples of a writer tell of participants and endpoints as lists of parameters: SPDP
/// and SEDP, secured or not (OMG DDSI-RTPS 2.5, 8.5.3 and 8.5.4).
bool is_discovery(EntityId writer);

/// Judges a parameter of discovery by its id: strings end within it, sequences are not longer than
/// it, locators are of kinds that are known (9.3.2.3, and those of Fast DDS for shared memory and
/// of Cyclone DDS for raw Ethernet). Others pass.
Objection judge_discovered(const Parameter& parameter, Endianness endianness);

/// Judges the payload of a sample of discovery: PL_CDR (10.2), parameters and their values.
/// @param source  whom the GUIDs in it have to belong to; null: anybody.
Objection judge_discovery(Octets payload, const GuidPrefix* source);

/// Judges the payload of a participant message, which tells that writers are alive (9.6.3.1).
Objection judge_participant_message(Octets payload);

}  // namespace hal::rtps
