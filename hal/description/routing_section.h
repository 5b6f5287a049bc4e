#pragma once

#include <array>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/routing/ports.h"
#include "hal/routing/routing_config.h"

namespace hal::description {

/// The algorithms by their names in files.
inline constexpr std::array<config::Option<routing::Algorithm>, 5> kRoutingAlgorithms{
    {{"ants", routing::Algorithm::kAnts},
     {"anthocnet", routing::Algorithm::kAntHocNet},
     {"aodv", routing::Algorithm::kAodv},
     {"flooding", routing::Algorithm::kFlooding},
     {"none", routing::Algorithm::kNone}}};

/// `routing:` of a scenario, or of a real agent's file: a mapping, or `none`.
/// @param link  what the link under the router tells of its frames. If it reports what becomes of
///              them, the keys of hop acknowledgements and hellos are refused; if it does not tell
///              how strong they were, so is the metric of the signal to noise ratio.
routing::RoutingConfig read_routing(config::Mapping& in, const routing::LinkCapabilities& link);
void write_routing(config::Writer& out, const routing::RoutingConfig& config,
                   const routing::LinkCapabilities& link);

}  // namespace hal::description
