#pragma once

#include <fastdds/rtps/transport/TransportInterface.h>

#include "gateway/guard/fastdds.h"
#include "gateway/guard/handed_sockets.h"

namespace gateway::guard {

/// UDP over existing sockets, for a participant whose locators all belong to these sockets and to
/// 127.0.0.1. It opens no other sockets, so the process's own network namespace does not matter.
///
///   qos.transport().user_transports.assign(1,
///       std::make_shared<HandedTransportDescriptor>(handed, 4U << 20U));
struct HandedTransportDescriptor : eprosima::fastdds::rtps::TransportDescriptorInterface {
  /// @param handed  outlives the participant.   @param send_buffer  of the socket [byte].
  HandedTransportDescriptor(const HandedSockets& handed, std::uint32_t send_buffer)
      : TransportDescriptorInterface(eprosima::fastdds::rtps::s_maximumMessageSize,
                                     eprosima::fastdds::rtps::s_maximumInitialPeersRange),
        sockets(&handed),
        send_buffer_size(send_buffer) {}
  eprosima::fastdds::rtps::TransportInterface* create_transport() const override;
  std::uint32_t min_send_buffer_size() const override { return send_buffer_size; }

  const HandedSockets* sockets;
  std::uint32_t send_buffer_size;
};

}  // namespace gateway::guard
