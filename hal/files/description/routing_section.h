#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::files::description {

/// The algorithms that files can name, with `none` last.
std::vector<config::Option<node::routing::Algorithm>> routing_algorithms();

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
/// @param c  must have the algorithm to write; receives what the file states.
/// @param link  capabilities of the link below the router. With transmit status, the keys of hop
///   acknowledgements and hellos are refused; without RSSI, so is the signal-to-noise metric.
void routing_key(Fields& io, node::routing::RoutingConfig& c,
                 const node::routing::LinkCapabilities& link);

}  // namespace hal::files::description
