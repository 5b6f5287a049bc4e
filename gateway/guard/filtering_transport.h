#pragma once

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>

#include <memory>

#include "gateway/guard/datagram_filter.h"
#include "gateway/guard/fastdds.h"
#include "gateway/guard/sending_socket.h"

namespace gateway::guard {

/// A UDPv4 transport whose datagrams pass a filter before they reach Fast DDS, and which can send
/// from a socket of its own.
///
///   qos.transport().user_transports.assign(
///       1, std::make_shared<FilteringTransportDescriptor>(udp, filter, nullptr));
struct FilteringTransportDescriptor : eprosima::fastdds::rtps::ChainingTransportDescriptor {
  FilteringTransportDescriptor(
      std::shared_ptr<eprosima::fastdds::rtps::TransportDescriptorInterface> udp,
      std::shared_ptr<DatagramFilter> datagram_filter,
      std::shared_ptr<SendingSocket> sending_socket)
      : ChainingTransportDescriptor(std::move(udp)),
        filter(std::move(datagram_filter)),
        sender(std::move(sending_socket)) {}
  eprosima::fastdds::rtps::TransportInterface* create_transport() const override;

  std::shared_ptr<DatagramFilter> filter;
  std::shared_ptr<SendingSocket> sender;  ///< Null: the transport below sends.
};

}  // namespace gateway::guard
