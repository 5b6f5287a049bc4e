#pragma once

#include "hal/files/description/fields.h"
#include "hal/node/routing/ports.h"
#include "hal/node/routing/routing_config.h"

namespace hal::files::description {

/// How messages choose among routes: the keys that a message class may set for itself.
void class_keys(Fields& io, node::routing::RouteChoice& c,
                const node::routing::LinkCapabilities& link);

/// The key `classes`: message classes that choose by keys of their own.
void classes_key(Fields& io, node::routing::RoutingConfig& c,
                 const node::routing::LinkCapabilities& link);

}  // namespace hal::files::description
