#include "gateway/guard/handed_transport.h"

#include <fastdds/rtps/network/SenderResource.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <cerrno>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "gateway/guard/send_from.h"

namespace gateway::guard {
namespace {

namespace base = eprosima::fastdds::rtps;
using rtps::Locator_t;

Locator_t locator_of(const sockaddr_in& address) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = ntohs(address.sin_port);
  rtps::IPLocator::setIPv4(locator, reinterpret_cast<const rtps::octet*>(&address.sin_addr));
  return locator;
}

/// Sends all datagrams from one socket.
class HandedSender : public rtps::SenderResource {
 public:
  explicit HandedSender(int socket) : SenderResource(LOCATOR_KIND_UDPv4) {
    send_lambda_ = [socket](const rtps::octet* data, std::uint32_t size,
                            rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
                            const std::chrono::steady_clock::time_point& /*until*/) {
      return send_from(socket, data, size, *begin, *end);
    };
  }
};

/// A thread that passes on the datagrams that a socket receives.
class HandedReceiver {
 public:
  HandedReceiver(int socket, const Locator_t& local, base::TransportReceiverInterface* receiver)
      : socket_(socket), local_(local), receiver_(receiver), thread_([this] { receive(); }) {}
  ~HandedReceiver() {
    ends_ = true;
    // Fails because the socket is not connected, but wakes up its reader.
    shutdown(socket_, SHUT_RD);
    thread_.join();
  }
  HandedReceiver(const HandedReceiver&) = delete;
  HandedReceiver& operator=(const HandedReceiver&) = delete;

 private:
  void receive() const {
    std::vector<rtps::octet> datagram(base::s_maximumMessageSize);
    while (!ends_) {
      sockaddr_in from{};
      socklen_t length = sizeof(from);
      const ssize_t size = recvfrom(socket_, datagram.data(), datagram.size(), 0,
                                    reinterpret_cast<sockaddr*>(&from), &length);
      if (size <= 0 || ends_) continue;
      receiver_->OnDataReceived(datagram.data(), static_cast<std::uint32_t>(size), local_,
                                locator_of(from));
    }
  }

  int socket_;
  Locator_t local_;
  base::TransportReceiverInterface* receiver_;
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// What Fast DDS 2.9 requires of a transport. It behaves as UDPv4Transport with a whitelist of
/// 127.0.0.1, except that it opens no sockets.
class HandedTransport : public base::TransportInterface {
 public:
  explicit HandedTransport(const HandedTransportDescriptor& descriptor)
      : TransportInterface(LOCATOR_KIND_UDPv4), descriptor_(descriptor) {}

  bool init(const rtps::PropertyPolicy* /*properties*/) override { return true; }
  base::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }
  std::uint32_t max_recv_buffer_size() const override { return descriptor_.maxMessageSize; }

  bool IsLocatorSupported(const Locator_t& locator) const override {
    return locator.kind == LOCATOR_KIND_UDPv4;
  }
  bool is_locator_allowed(const Locator_t& locator) const override {
    return IsLocatorSupported(locator) && rtps::IPLocator::isLocal(locator);
  }
  bool is_local_locator(const Locator_t& locator) const override {
    return rtps::IPLocator::isLocal(locator);
  }
  bool DoInputLocatorsMatch(const Locator_t& one, const Locator_t& other) const override {
    return one.port == other.port;
  }
  Locator_t RemoteToMainLocal(const Locator_t& remote) const override {
    Locator_t local = remote;
    local.set_Invalid_Address();
    return local;
  }
  bool transform_remote_locator(const Locator_t& remote, Locator_t& result) const override {
    if (!is_locator_allowed(remote)) return false;
    result = remote;
    return true;
  }
  rtps::LocatorList_t NormalizeLocator(const Locator_t& locator) override {
    rtps::LocatorList_t list;
    list.push_back(locator);
    return list;
  }

  bool OpenOutputChannel(base::SendResourceList& senders, const Locator_t& locator) override;
  bool OpenInputChannel(const Locator_t& locator, base::TransportReceiverInterface* receiver,
                        std::uint32_t most) override;
  bool IsInputChannelOpen(const Locator_t& locator) const override;
  bool CloseInputChannel(const Locator_t& locator) override;
  void select_locators(rtps::LocatorSelector& selector) const override;

  // The participant specifies all its locators itself, so no default locators are needed.
  void AddDefaultOutputLocator(rtps::LocatorList_t& /*list*/) override {}
  bool getDefaultMetatrafficMulticastLocators(rtps::LocatorList_t& /*list*/,
                                              std::uint32_t /*port*/) const override {
    return false;
  }
  bool getDefaultMetatrafficUnicastLocators(rtps::LocatorList_t& /*list*/,
                                            std::uint32_t /*port*/) const override {
    return false;
  }
  bool getDefaultUnicastLocators(rtps::LocatorList_t& /*list*/,
                                 std::uint32_t /*port*/) const override {
    return false;
  }
  bool fillMetatrafficMulticastLocator(Locator_t& /*locator*/,
                                       std::uint32_t /*port*/) const override {
    return false;
  }
  bool fillMetatrafficUnicastLocator(Locator_t& locator, std::uint32_t /*port*/) const override {
    return locator.port != 0;
  }
  bool fillUnicastLocator(Locator_t& locator, std::uint32_t /*port*/) const override {
    return locator.port != 0;
  }
  bool configureInitialPeerLocator(Locator_t& locator, const rtps::PortParameters& /*ports*/,
                                   std::uint32_t /*domain*/,
                                   rtps::LocatorList_t& list) const override {
    list.push_back(locator);
    return true;
  }

 private:
  HandedTransportDescriptor descriptor_;
  std::atomic<bool> has_sender_{false};
  mutable std::mutex mutex_;
  std::map<std::uint32_t, std::unique_ptr<HandedReceiver>> receivers_;  ///< By port.
};

bool HandedTransport::OpenOutputChannel(base::SendResourceList& senders, const Locator_t& locator) {
  if (!IsLocatorSupported(locator)) return false;
  if (has_sender_.exchange(true)) return true;
  senders.push_back(std::make_unique<HandedSender>(descriptor_.sockets->data.descriptor.number()));
  return true;
}

bool HandedTransport::OpenInputChannel(const Locator_t& locator,
                                       base::TransportReceiverInterface* receiver,
                                       std::uint32_t /*most*/) {
  if (!is_locator_allowed(locator)) return false;
  for (const HandedSockets::Bound* one :
       {&descriptor_.sockets->metatraffic, &descriptor_.sockets->data}) {
    if (one->port != locator.port) continue;
    const std::lock_guard lock(mutex_);
    receivers_[locator.port] =
        std::make_unique<HandedReceiver>(one->descriptor.number(), locator, receiver);
    return true;
  }
  return false;
}

bool HandedTransport::IsInputChannelOpen(const Locator_t& locator) const {
  const std::lock_guard lock(mutex_);
  return IsLocatorSupported(locator) && receivers_.contains(locator.port);
}

bool HandedTransport::CloseInputChannel(const Locator_t& locator) {
  std::unique_ptr<HandedReceiver> receiver;
  {
    const std::lock_guard lock(mutex_);
    const auto found = receivers_.find(locator.port);
    if (found == receivers_.end()) return false;
    receiver = std::move(found->second);
    receivers_.erase(found);
  }
  return true;  // the receiver's thread, which may take the lock, ends without it
}

void HandedTransport::select_locators(rtps::LocatorSelector& selector) const {
  auto& entries = selector.transport_starts();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    rtps::LocatorSelectorEntry& entry = *entries[i];
    if (!entry.transport_should_process) continue;
    bool is_selected = false;
    for (std::size_t j = 0; j < entry.unicast.size(); ++j) {
      if (!IsLocatorSupported(entry.unicast[j]) || selector.is_selected(entry.unicast[j])) continue;
      entry.state.unicast.push_back(j);
      is_selected = true;
    }
    if (is_selected) selector.select(i);
  }
}

}  // namespace

base::TransportInterface* HandedTransportDescriptor::create_transport() const {
  return new HandedTransport(*this);
}

}  // namespace gateway::guard
