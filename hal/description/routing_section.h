#pragma once

#include <array>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/routing/ports.h"
#include "hal/routing/routing_config.h"

namespace hal::description {

inline config::Option<routing::Algorithm> option_of(routing::Algorithm algorithm) {
  return {algorithm.name(), algorithm};
}

/// The algorithms that files can name.
inline const std::array kRoutingAlgorithms{
    option_of(routing::Algorithm::kAnts), option_of(routing::Algorithm::kAntHocNet),
    option_of(routing::Algorithm::kAodv), option_of(routing::Algorithm::kFlooding),
    option_of(routing::Algorithm::kNone)};

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
/// @param link  what the link under the router tells of its frames. If it reports what becomes of
///              them, the keys of hop acknowledgements and hellos are refused; if it does not tell
///              how strong they were, so is the metric of the signal to noise ratio.
routing::RoutingConfig read_routing(config::Mapping& in, const routing::LinkCapabilities& link);
void write_routing(config::Writer& out, const routing::RoutingConfig& config,
                   const routing::LinkCapabilities& link);

}  // namespace hal::description
