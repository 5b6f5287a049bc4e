#pragma once

#include <array>

#include "hal/files/description/fields.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::files::description {

inline config::Option<node::routing::Algorithm> option_of(node::routing::Algorithm algorithm) {
  return {algorithm.name(), algorithm};
}

/// The algorithms that files can name.
inline const std::array kRoutingAlgorithms{
    option_of(node::routing::Algorithm::kAnts), option_of(node::routing::Algorithm::kAntHocNet),
    option_of(node::routing::Algorithm::kAodv), option_of(node::routing::Algorithm::kFlooding),
    option_of(node::routing::Algorithm::kNone)};

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
/// @param c  of which the algorithm and what files say of it is written. @param link  what the link
/// under the router tells of its frames. If it reports what becomes of
///              them, the keys of hop acknowledgements and hellos are refused; if it does not tell
///              how strong they were, so is the metric of the signal to noise ratio.
void routing_key(Fields& io, node::routing::RoutingConfig& c,
                 const node::routing::LinkCapabilities& link);

}  // namespace hal::files::description
