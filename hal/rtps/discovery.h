#pragma once

#include "hal/rtps/cursor.h"
#include "hal/rtps/entity_id.h"
#include "hal/rtps/fault.h"
#include "hal/rtps/parameter_list.h"

namespace hal::rtps {

/// Whether a writer's samples describe participants and endpoints as lists of parameters: SPDP and
/// SEDP, secured or not (OMG DDSI-RTPS 2.5, 8.5.3 and 8.5.4).
bool is_discovery(EntityId writer);

/// Checks a parameter of discovery by its id: strings end within it, sequences are not longer than
/// it, locators are of known kinds (9.3.2.3, and those of Fast DDS for shared memory and of Cyclone
/// DDS for raw Ethernet). Accepts all other parameters.
Objection judge_discovered(const Parameter& parameter, Endianness endianness);

/// Checks the payload of a discovery sample: PL_CDR (10.2), parameters and their values.
/// @param source  participant to which the GUIDs in it must belong; null: any.
Objection judge_discovery(Octets payload, const GuidPrefix* source);

/// Checks the payload of a participant message, which asserts the liveliness of writers (9.6.3.1).
Objection judge_participant_message(Octets payload);

}  // namespace hal::rtps
