// What the peer programs on AODV have in common: stations with IP and AODV that know each other's
// MAC addresses in one of three ways, flows of constant rate between them, and what is counted.
// Uses ns-3's public headers only (Debian: libns3-dev, ns-3.37).
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "ns3/aodv-module.h"
#include "ns3/core-module.h"
#include "ns3/internet-module.h"
#include "ns3/network-module.h"
#include "ns3/wifi-module.h"

namespace peer {

constexpr uint16_t kPort = 9;
constexpr uint32_t kMark = 0x62726b61;  // of packets of data

/// Of AODV and of ARP. The defaults are those of stock ns-3.37.
struct Stack {
  bool hello = true, destination_only = false, gratuitous = true;
  unsigned hello_loss = 2;
  double my_route = 11.2;   // s
  double active_route = 3;  // s
  double arp_dead = 100;    // s
  /// How stations know each other's MAC addresses. arp: they ask, as stock ns-3 does. filled: by
  /// NeighborCacheHelper, whose entries are neither alive nor permanent, so that AODV finds no
  /// address of a neighbour in them and no frame that the MAC gave up tells it anything.
  /// permanent: entries that AODV finds.
  std::string addresses = "arp";

  void add_to(ns3::CommandLine& line) {
    line.AddValue("hello", "AODV's EnableHello", hello);
    line.AddValue("destination_only", "AODV's DestinationOnly", destination_only);
    line.AddValue("gratuitous", "AODV's GratuitousReply", gratuitous);
    line.AddValue("hello_loss", "AODV's AllowedHelloLoss", hello_loss);
    line.AddValue("my_route", "AODV's MyRouteTimeout, s: RFC 3561 has 6", my_route);
    line.AddValue("active_route", "AODV's ActiveRouteTimeout, s", active_route);
    line.AddValue("arp_dead", "DeadTimeout of ARP's entries, s", arp_dead);
    line.AddValue("addresses", "arp, filled or permanent", addresses);
  }
};

/// Entries that are found whenever they are looked for, of all stations at all others.
inline void add_permanent(const ns3::NetDeviceContainer& devices,
                          const ns3::Ipv4InterfaceContainer& interfaces) {
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const auto cache =
        devices.Get(i)->GetNode()->GetObject<ns3::Ipv4L3Protocol>()->GetInterface(1)->GetArpCache();
    for (uint32_t j = 0; j < devices.GetN(); ++j) {
      if (i == j) continue;
      const auto entry = cache->Add(interfaces.GetAddress(j));
      entry->SetMacAddress(devices.Get(j)->GetAddress());
      entry->MarkPermanent();
    }
  }
}

inline ns3::Ipv4InterfaceContainer install(const Stack& stack,
                                           const ns3::NetDeviceContainer& devices) {
  using namespace ns3;
  Config::SetDefault("ns3::ArpCache::DeadTimeout", TimeValue(Seconds(stack.arp_dead)));
  NodeContainer nodes;
  for (uint32_t i = 0; i < devices.GetN(); ++i) nodes.Add(devices.Get(i)->GetNode());
  AodvHelper aodv;
  aodv.Set("EnableHello", BooleanValue(stack.hello));
  aodv.Set("DestinationOnly", BooleanValue(stack.destination_only));
  aodv.Set("GratuitousReply", BooleanValue(stack.gratuitous));
  aodv.Set("AllowedHelloLoss", UintegerValue(stack.hello_loss));
  aodv.Set("MyRouteTimeout", TimeValue(Seconds(stack.my_route)));
  aodv.Set("ActiveRouteTimeout", TimeValue(Seconds(stack.active_route)));
  InternetStackHelper internet;
  internet.SetRoutingHelper(aodv);
  internet.Install(nodes);
  Ipv4AddressHelper addresses;
  addresses.SetBase("10.0.0.0", "255.255.255.0");
  const auto interfaces = addresses.Assign(devices);
  if (stack.addresses == "filled") NeighborCacheHelper().PopulateNeighborCache();
  if (stack.addresses == "permanent") add_permanent(devices, interfaces);
  aodv.AssignStreams(nodes, 2000);
  return interfaces;
}

/// Of all stations.
struct Counts {
  uint64_t hellos = 0, rreq = 0, rreq_relayed = 0, rrep = 0, rerr = 0, data = 0;
  uint64_t given_up = 0;         // frames, at the retry limit
  uint64_t given_up_data = 0;    // those of data
  uint64_t given_up_beyond = 0;  // those of data to a station that was beyond `range`
  // those of data by a station that had given up one to the same station within kRecent before
  uint64_t given_up_again = 0;
  double range = 0;  // m; 0: not counted
};

constexpr double kRecent = 3;  // s; AODV's ACTIVE_ROUTE_TIMEOUT

/// What was seen last of a packet of data that did not arrive.
enum class Fate { kNone, kGivenUp, kExpired, kArp, kTtl, kNoRoute };

struct Message {
  ns3::Time at;
  bool arrived = false;
  Fate fate = Fate::kNone;
};

/// One run's.
struct Tally {
  Counts counts;
  std::vector<double> delays;                  // ms
  std::vector<std::vector<Message>> messages;  // by flow and number
  std::map<ns3::Mac48Address, ns3::Ptr<ns3::Node>> nodes;
  std::map<std::pair<uint32_t, ns3::Mac48Address>, ns3::Time> given_up;  // last, of data

  std::size_t sent() const {
    std::size_t total = 0;
    for (const auto& flow : messages) total += flow.size();
    return total;
  }
  std::size_t ended(Fate fate) const {
    std::size_t total = 0;
    for (const auto& flow : messages) {
      total += std::count_if(flow.begin(), flow.end(), [fate](const Message& one) {
        return !one.arrived && one.fate == fate;
      });
    }
    return total;
  }
  double quantile(double share) {
    if (delays.empty()) return 0;
    std::sort(delays.begin(), delays.end());
    const double place = share * static_cast<double>(delays.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, delays.size() - 1);
    return delays[below] + (place - static_cast<double>(below)) * (delays[above] - delays[below]);
  }
  double mean() const {
    double sum = 0;
    for (const double one : delays) sum += one;
    return delays.empty() ? 0 : sum / static_cast<double>(delays.size());
  }
};

inline Tally& tally() {
  static Tally one;
  return one;
}

/// The message whose payload, of `size` bytes, ends the packet; null: it is none of data.
inline Message* message_in(ns3::Ptr<const ns3::Packet> packet, uint32_t size) {
  if (packet->GetSize() < size) return nullptr;
  std::array<uint32_t, 3> head{};
  packet->CreateFragment(packet->GetSize() - size, size)
      ->CopyData(reinterpret_cast<uint8_t*>(head.data()), sizeof head);
  if (head[0] != kMark) return nullptr;
  return &tally().messages.at(head[1]).at(head[2]);
}

struct Flow {
  uint32_t source = 0, destination = 0;
  double start = 0;  // s
};

struct Load {
  uint32_t size = 64;  // bytes of UDP's payload, a multiple of 4
  double rate = 4;     // per second
  double stop = 100;   // s
};

inline void send(ns3::Ptr<ns3::Socket> socket, uint32_t flow, Load load) {
  using namespace ns3;
  if (Simulator::Now() >= Seconds(load.stop)) return;
  std::vector<uint32_t> payload(load.size / 4);
  auto& messages = tally().messages[flow];
  payload[0] = kMark;
  payload[1] = flow;
  payload[2] = static_cast<uint32_t>(messages.size());
  messages.push_back({Simulator::Now()});
  socket->Send(Create<Packet>(reinterpret_cast<const uint8_t*>(payload.data()), load.size));
  Simulator::Schedule(Seconds(1 / load.rate), &send, socket, flow, load);
}

/// A second copy of a message does not count.
inline void receive(ns3::Ptr<ns3::Socket> socket) {
  while (const ns3::Ptr<ns3::Packet> packet = socket->Recv()) {
    Message* const message = message_in(packet, packet->GetSize());
    if (!message || message->arrived) continue;
    message->arrived = true;
    tally().delays.push_back((ns3::Simulator::Now() - message->at).GetSeconds() * 1e3);
  }
}

inline void count_aodv(ns3::Ptr<ns3::Packet> packet) {
  using namespace ns3;
  Counts& counts = tally().counts;
  aodv::TypeHeader type;
  packet->RemoveHeader(type);
  if (type.Get() == aodv::AODVTYPE_RREQ) {
    aodv::RreqHeader rreq;
    packet->RemoveHeader(rreq);
    ++(rreq.GetHopCount() == 0 ? counts.rreq : counts.rreq_relayed);
  } else if (type.Get() == aodv::AODVTYPE_RREP) {
    aodv::RrepHeader rrep;
    packet->RemoveHeader(rrep);
    ++(rrep.GetDst() == rrep.GetOrigin() ? counts.hellos : counts.rrep);
  } else if (type.Get() == aodv::AODVTYPE_RERR) {
    ++counts.rerr;
  }
}

inline void count(ns3::Ptr<const ns3::Packet> packet, ns3::Ptr<ns3::Ipv4>, uint32_t interface) {
  using namespace ns3;
  if (interface == 0) return;  // loopback
  const Ptr<Packet> copy = packet->Copy();
  Ipv4Header ip;
  copy->RemoveHeader(ip);
  if (ip.GetProtocol() != 17) return;
  UdpHeader udp;
  copy->RemoveHeader(udp);
  if (udp.GetDestinationPort() == kPort) ++tally().counts.data;
  if (udp.GetDestinationPort() == aodv::RoutingProtocol::AODV_PORT) count_aodv(copy);
}

inline void note(ns3::Ptr<const ns3::Packet> packet, uint32_t size, Fate fate) {
  if (Message* const message = message_in(packet, size)) message->fate = fate;
}

inline double distance(ns3::Ptr<ns3::Node> from, ns3::Ptr<ns3::Node> to) {
  return ns3::CalculateDistance(from->GetObject<ns3::MobilityModel>()->GetPosition(),
                                to->GetObject<ns3::MobilityModel>()->GetPosition());
}

inline void drop_frame(ns3::Ptr<ns3::Node> node, uint32_t size, ns3::WifiMacDropReason reason,
                       ns3::Ptr<const ns3::WifiMpdu> frame) {
  Counts& counts = tally().counts;
  const bool given_up = reason == ns3::WIFI_MAC_DROP_REACHED_RETRY_LIMIT;
  if (given_up) ++counts.given_up;
  Message* const message = message_in(frame->GetPacket(), size);
  if (!message) return;
  message->fate = given_up ? Fate::kGivenUp : Fate::kExpired;
  if (!given_up) return;
  ++counts.given_up_data;
  const auto link = std::make_pair(node->GetId(), frame->GetHeader().GetAddr1());
  const auto last = tally().given_up.find(link);
  const ns3::Time now = ns3::Simulator::Now();
  if (last != tally().given_up.end() && now - last->second < ns3::Seconds(kRecent))
    ++counts.given_up_again;
  tally().given_up[link] = now;
  const auto to = tally().nodes.find(frame->GetHeader().GetAddr1());
  if (to != tally().nodes.end() && distance(node, to->second) > counts.range)
    ++counts.given_up_beyond;
}

inline void drop_packet(uint32_t size, const ns3::Ipv4Header&, ns3::Ptr<const ns3::Packet> packet,
                        ns3::Ipv4L3Protocol::DropReason reason, ns3::Ptr<ns3::Ipv4>, uint32_t) {
  note(packet, size, reason == ns3::Ipv4L3Protocol::DROP_TTL_EXPIRED ? Fate::kTtl : Fate::kNoRoute);
}

inline void drop_at_arp(uint32_t size, ns3::Ptr<const ns3::Packet> packet) {
  note(packet, size, Fate::kArp);
}

/// Packets that arrive, that are sent and that are dropped are counted.
inline void listen(const ns3::NetDeviceContainer& devices, uint32_t size) {
  using namespace ns3;
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const Ptr<Node> node = devices.Get(i)->GetNode();
    const auto sink = Socket::CreateSocket(node, UdpSocketFactory::GetTypeId());
    sink->Bind(InetSocketAddress(Ipv4Address::GetAny(), kPort));
    sink->SetRecvCallback(MakeCallback(&receive));
    const auto ip = node->GetObject<Ipv4L3Protocol>();
    ip->TraceConnectWithoutContext("Tx", MakeCallback(&count));
    ip->TraceConnectWithoutContext("Drop", MakeBoundCallback(&drop_packet, size));
    node->GetObject<ArpL3Protocol>()->TraceConnectWithoutContext(
        "Drop", MakeBoundCallback(&drop_at_arp, size));
    DynamicCast<WifiNetDevice>(devices.Get(i))
        ->GetMac()
        ->TraceConnectWithoutContext("DroppedMpdu", MakeBoundCallback(&drop_frame, node, size));
    tally().nodes[Mac48Address::ConvertFrom(devices.Get(i)->GetAddress())] = node;
  }
}

inline void start(const Load& load, const std::vector<Flow>& flows,
                  const ns3::NetDeviceContainer& devices,
                  const ns3::Ipv4InterfaceContainer& interfaces) {
  using namespace ns3;
  tally().messages.resize(flows.size());
  for (uint32_t i = 0; i < flows.size(); ++i) {
    const auto socket = Socket::CreateSocket(devices.Get(flows[i].source)->GetNode(),
                                             UdpSocketFactory::GetTypeId());
    socket->Connect(InetSocketAddress(interfaces.GetAddress(flows[i].destination), kPort));
    Simulator::Schedule(Seconds(flows[i].start), &send, socket, i, load);
  }
}

}  // namespace peer
