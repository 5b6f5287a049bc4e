#include "hal/node/routing/protocol.h"

namespace hal::node::routing {

std::unique_ptr<Protocol> make_protocol(AgentId self, const RoutingConfig& config,
                                        const RouterStreams& streams, const RouterPorts& ports) {
  return config.algorithm.kind().make(self, config, streams, ports);
}

}  // namespace hal::node::routing
