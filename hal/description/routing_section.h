#pragma once

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/routing/routing_config.h"

namespace hal::description {

/// What the link under the router tells of its frames.
enum class TransmitStatus {
  kReported,  ///< The keys of hop acknowledgements and hellos are refused.
  kNone,      ///< The router finds out for itself: they are used.
};

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
routing::RoutingConfig read_routing(config::Mapping& in, TransmitStatus status);
void write_routing(config::Writer& out, const routing::RoutingConfig& config,
                   TransmitStatus status);

}  // namespace hal::description
