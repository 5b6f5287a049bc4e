#pragma once

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "hal/node/agent/ports.h"
#include "hal/node/routing/ports.h"
#include "hal/robot/platform/event_loop.h"
#include "hal/robot/platform/interface_watch.h"
#include "hal/robot/radio/udp_address.h"

namespace hal::robot::radio {

struct UdpLinkConfig {
  AgentId self;
  std::string interface;  ///< E.g. "wlan0".
  std::string address;    ///< Address of the interface; empty: its first one.
  /// The same on every node of the network; 0: any free port, known to no other node.
  std::uint16_t port = 0;
  double bit_rate = 1e6;  ///< bit/s, > 0; nominal, for the delay statistics of routes.
  double power = 0.1;     ///< W, >= 0, of the transmitter, for the energy of routes.
};

/// Statistics of datagrams since the start.
struct LinkCounts {
  std::uint64_t sent = 0;
  std::uint64_t received = 0;         ///< Frames passed on.
  std::uint64_t own = 0;              ///< Own broadcasts that were received again.
  std::uint64_t malformed = 0;        ///< Not in this format.
  std::uint64_t foreign = 0;          ///< In this format, but from a port other than the network's.
  std::uint64_t address_clashes = 0;  ///< From another node with this agent's address.
  std::uint64_t unknown_neighbour = 0;  ///< Not sent: the destination was never heard.
  std::uint64_t not_sent = 0;           ///< Too long, or refused by the system: queue full, …
  /// Not sent, or received but not passed on, while switched off.
  std::uint64_t radio_off = 0;
  bool operator==(const LinkCounts&) const = default;
};

/// One hop over UDP on a network interface, in place of the simulator's MAC. A frame for everyone
/// is sent to the broadcast address of the interface's network; one for a neighbour, to the address
/// from which that neighbour's frames came. If the interface gets another address, or disappears
/// for a while, the link continues as soon as there is an address; frames sent meanwhile are lost.
///
/// The link reports neither reception nor signal strength: all capabilities() are false. Nodes are
/// not authenticated: anyone on the network can pretend to be any agent. Only the loop's thread.
class UdpLink final : public node::agent::Link {
 public:
  using FrameHandler =
      std::function<void(const node::routing::Reception&, std::span<const std::uint8_t> frame)>;

  /// Waits for an interface that has no address yet.
  /// @param loop  outlives the link.
  /// @throws std::system_error  the port is in use, or not permitted.
  /// @throws std::runtime_error  no such interface or address.
  UdpLink(const UdpLinkConfig& config, platform::EventLoop& loop);
  ~UdpLink() override;
  UdpLink(const UdpLink&) = delete;
  UdpLink& operator=(const UdpLink&) = delete;

  /// Sets the receiver of the neighbours' frames. @pre the loop is not running yet.
  void attach(FrameHandler on_frame) { on_frame_ = std::move(on_frame); }

  node::routing::LinkCapabilities capabilities() const override { return {}; }
  /// A frame that cannot be sent, or is longer than kMaxFrame, is counted and dropped. Its priority
  /// is the class selector of the datagram's DSCP, from which Linux takes the access category.
  void transmit(AgentId next_hop, Bytes frame, const node::routing::LinkOptions& options) override;
  /// Transmission time of a frame with the size of the last one, at the nominal bit rate.
  Duration expected_delay() const override;
  double transmit_energy(std::size_t bytes) const override;

  /// When off, nothing is sent and no received frame is passed on.
  void set_radio(bool on) override { radio_on_ = on; }

  const LinkCounts& counts() const { return counts_; }
  std::string own_address() const;  ///< "10.0.0.1:7300"
  /// Why there is no network; empty if there is.
  const std::string& trouble() const { return trouble_; }
  std::uint16_t port() const { return config_.port; }

 private:
  void open(const UdpAddresses& addresses);
  void close();
  int open_socket(in_addr address, bool shared) const;
  void renew();
  void receive(int socket);
  void take(std::span<const std::uint8_t> datagram, const sockaddr_in& from);
  bool is_from_here(const sockaddr_in& from) const;
  void note_error(int error);
  double airtime(std::size_t bytes) const;  ///< s

  UdpLinkConfig config_;
  platform::EventLoop& loop_;
  UdpAddresses addresses_;
  /// Sends, and receives frames for this node alone. -1: there is no network.
  int own_ = -1;
  int broadcast_ = -1;  ///< Receives frames for everyone.
  std::array<platform::EventLoop::Watch, 2> watches_{};
  std::optional<platform::InterfaceWatch> interface_watch_;
  platform::EventLoop::Handle retry_ = 0;
  FrameHandler on_frame_;
  std::map<AgentId, sockaddr_in> neighbours_;
  LinkCounts counts_;
  std::size_t last_size_ = 0;
  int last_error_ = 0;
  std::string trouble_;
  bool radio_on_ = true;
};

}  // namespace hal::robot::radio
