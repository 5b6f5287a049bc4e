#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/routing/routing_config.h"

namespace hal::description {

/// `routing:` of a scenario, or of a real agent's file.
routing::RoutingConfig read_routing(config::Mapping in);
void write_routing(config::Writer& out, const routing::RoutingConfig& config);

}  // namespace hal::description
