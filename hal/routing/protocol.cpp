#include "hal/routing/protocol.h"

#include "hal/routing/ant_routing.h"
#include "hal/routing/anthocnet.h"
#include "hal/routing/aodv_routing.h"
#include "hal/routing/flood_routing.h"
#include "hal/routing/one_hop.h"
#include "hal/types/check.h"

namespace hal::routing {

std::unique_ptr<Protocol> make_protocol(AgentId self, const RoutingConfig& config,
                                        const RouterStreams& streams, const RouterPorts& ports) {
  switch (config.algorithm) {
    case Algorithm::kAnts:
      return std::make_unique<AntRouting>(self, config, streams, ports);
    case Algorithm::kNone:
      return std::make_unique<OneHop>(self, ports);
    case Algorithm::kFlooding:
      return std::make_unique<FloodRouting>(self, config, streams, ports);
    case Algorithm::kAodv:
      return std::make_unique<AodvRouting>(self, config, streams, ports);
    case Algorithm::kAntHocNet:
      return std::make_unique<AntHocNet>(self, config, streams, ports);
  }
  BARAKA_CHECK(false);
}

}  // namespace hal::routing
