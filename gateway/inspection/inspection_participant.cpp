#include "gateway/inspection/inspection_participant.h"

#include "gateway/domain/participant.h"

namespace gateway::inspection {

InspectionParticipant::InspectionParticipant(const Settings& settings)
    : domain_(settings.domain),
      mark_(settings.domain),
      participant_(std::make_unique<domain::Participant>(
          domain::Participant::inspection(settings.domain, settings.addresses, settings.name))) {}

InspectionParticipant::~InspectionParticipant() = default;

}  // namespace gateway::inspection
