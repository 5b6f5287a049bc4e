#include "gateway/guard/filtering_transport.h"

#include <cstddef>

#include "gateway/guard/send_from.h"

namespace gateway::guard {
namespace {

namespace transport = eprosima::fastdds::rtps;

UdpSender sender_at(const rtps::Locator_t& locator) {
  UdpSender sender;
  for (int i = 12; i < 16; ++i) sender.address = sender.address << 8U | locator.address[i];
  sender.port = static_cast<std::uint16_t>(locator.port);
  return sender;
}

class FilteringTransport : public transport::ChainingTransport {
 public:
  explicit FilteringTransport(const FilteringTransportDescriptor& descriptor)
      : ChainingTransport(descriptor), descriptor_(descriptor) {}

  transport::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  // NOLINTNEXTLINE(readability-function-size): the parameters are Fast DDS's.
  bool send(rtps::SenderResource* low_sender, const rtps::octet* buffer, std::uint32_t size,
            rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    if (descriptor_.sender) {
      return send_from(descriptor_.sender->number(), buffer, size, *begin, *end);
    }
    return low_sender->send(buffer, size, begin, end, timeout);
  }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* buffer,
               std::uint32_t size, const rtps::Locator_t& local,
               const rtps::Locator_t& remote) override {
    const hal::rtps::Octets datagram = std::as_bytes(std::span(buffer, size));
    if (descriptor_.filter->lets_in(datagram, sender_at(remote))) {
      next->OnDataReceived(buffer, size, local, remote);
    }
  }

 private:
  FilteringTransportDescriptor descriptor_;
};

}  // namespace

transport::TransportInterface* FilteringTransportDescriptor::create_transport() const {
  return new FilteringTransport(*this);
}

}  // namespace gateway::guard
