#include "hal/dds/inspection/inspection_participant.h"

#include "hal/dds/participant.h"

namespace hal::dds {

InspectionParticipant::InspectionParticipant(const Settings& settings)
    : domain_(settings.domain),
      mark_(settings.domain),
      participant_(std::make_unique<Participant>(
          Participant::inspection(settings.domain, settings.addresses, settings.name))) {}

InspectionParticipant::~InspectionParticipant() = default;

}  // namespace hal::dds
