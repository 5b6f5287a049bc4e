#pragma once

#include <vector>

#include "hal/files/description/fields.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::files::description {

/// The algorithms that files can name, `none` behind the others.
std::vector<config::Option<node::routing::Algorithm>> routing_algorithms();

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
/// @param c  of which the algorithm and what files say of it is written. @param link  what the link
/// under the router tells of its frames. If it reports what becomes of
///              them, the keys of hop acknowledgements and hellos are refused; if it does not tell
///              how strong they were, so is the metric of the signal to noise ratio.
void routing_key(Fields& io, node::routing::RoutingConfig& c,
                 const node::routing::LinkCapabilities& link);

}  // namespace hal::files::description
