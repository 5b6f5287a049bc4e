// AODV of ns-3 on a grid of ad hoc stations, with flows of constant rate. Reads from standard input
// a line for each flow: number of the source and of the destination, row by row from 0, and start
// (s). Prints one line of CSV: seed, packets sent, delivered, delivered per sent, the median and
// the 95 % quantile of their delays (ms); then transmissions of all stations: hellos, RREQ by their
// originators, RREQ relayed, RREP, RERR, packets of data (each hop counts), and frames that the MAC
// gave up (retry limit).
#include <algorithm>
#include <iostream>

#include "ns3/aodv-module.h"
#include "ns3/internet-module.h"
#include "wifi.h"

using namespace ns3;

namespace {

struct Flow {
  uint32_t source = 0, destination = 0;
  double start = 0;  // s
};

std::vector<double> delays;            // ms
std::vector<std::vector<Time>> sent;   // by flow and number
std::vector<std::vector<bool>> taken;  // so that no copy counts

void send(Ptr<Socket> socket, uint32_t flow, unsigned size, Time period, Time stop) {
  if (Simulator::Now() >= stop) return;
  std::vector<uint32_t> payload(size / 4);
  payload[0] = flow;
  payload[1] = static_cast<uint32_t>(sent[flow].size());
  sent[flow].push_back(Simulator::Now());
  taken[flow].push_back(false);
  socket->Send(Create<Packet>(reinterpret_cast<const uint8_t*>(payload.data()), size));
  Simulator::Schedule(period, &send, socket, flow, size, period, stop);
}

void receive(Ptr<Socket> socket) {
  while (const Ptr<Packet> packet = socket->Recv()) {
    uint32_t head[2] = {0, 0};
    packet->CopyData(reinterpret_cast<uint8_t*>(head), sizeof head);
    if (taken.at(head[0]).at(head[1])) continue;
    taken[head[0]][head[1]] = true;
    delays.push_back((Simulator::Now() - sent[head[0]][head[1]]).GetSeconds() * 1e3);
  }
}

struct Counts {
  uint64_t hellos = 0, rreq = 0, rreq_relayed = 0, rrep = 0, rerr = 0, data = 0, given_up = 0;
} counts;

constexpr uint16_t kPort = 9;

void count(const Ptr<const Packet> packet, Ptr<Ipv4>, uint32_t interface) {
  if (interface == 0) return;  // loopback
  const Ptr<Packet> copy = packet->Copy();
  Ipv4Header ip;
  copy->RemoveHeader(ip);
  UdpHeader udp;
  if (ip.GetProtocol() != 17) return;
  copy->RemoveHeader(udp);
  if (udp.GetDestinationPort() == kPort) ++counts.data;
  if (udp.GetDestinationPort() != aodv::RoutingProtocol::AODV_PORT) return;
  aodv::TypeHeader type;
  copy->RemoveHeader(type);
  if (type.Get() == aodv::AODVTYPE_RREQ) {
    aodv::RreqHeader rreq;
    copy->RemoveHeader(rreq);
    ++(rreq.GetHopCount() == 0 ? counts.rreq : counts.rreq_relayed);
  } else if (type.Get() == aodv::AODVTYPE_RREP) {
    aodv::RrepHeader rrep;
    copy->RemoveHeader(rrep);
    ++(rrep.GetDst() == rrep.GetOrigin() ? counts.hellos : counts.rrep);
  } else if (type.Get() == aodv::AODVTYPE_RERR) {
    ++counts.rerr;
  }
}

void give_up(WifiMacDropReason reason, Ptr<const WifiMpdu>) {
  if (reason == WIFI_MAC_DROP_REACHED_RETRY_LIMIT) ++counts.given_up;
}

double quantile(double share) {
  if (delays.empty()) return 0;
  const double place = share * static_cast<double>(delays.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, delays.size() - 1);
  return delays[below] + (place - static_cast<double>(below)) * (delays[above] - delays[below]);
}

struct Options {
  peer::Radio radio;
  unsigned size = 64, seed = 1, side = 5, hello_loss = 2;
  double spacing = 40, rate = 4, stop = 100, my_route = 6;
  bool hello = true, per_flow = false;
};

Options options_of(int argc, char** argv) {
  Options options;
  CommandLine line;
  options.radio.add_to(line);
  line.AddValue("size", "payload of UDP, bytes, a multiple of 4", options.size);
  line.AddValue("side", "stations of a row, and rows", options.side);
  line.AddValue("spacing", "m", options.spacing);
  line.AddValue("rate", "packets per second of a flow", options.rate);
  line.AddValue("stop", "end of the flows, s", options.stop);
  line.AddValue("hello", "AODV's EnableHello", options.hello);
  line.AddValue("my_route", "AODV's MyRouteTimeout, s: RFC 3561 has 6, stock ns-3 11.2",
                options.my_route);
  line.AddValue("hello_loss", "AODV's AllowedHelloLoss", options.hello_loss);
  line.AddValue("per_flow", "print what each flow delivered, too", options.per_flow);
  line.AddValue("seed", "run number", options.seed);
  line.Parse(argc, argv);
  return options;
}

NetDeviceContainer grid(const Options& options) {
  std::vector<Vector> places;
  for (unsigned i = 0; i < options.side * options.side; ++i) {
    places.emplace_back(options.spacing * (i % options.side), options.spacing * (i / options.side),
                        1.5);
  }
  return peer::stations(options.radio, places, peer::log_distance());
}

Ipv4InterfaceContainer install(const Options& options, const NetDeviceContainer& devices) {
  NodeContainer nodes;
  for (uint32_t i = 0; i < devices.GetN(); ++i) nodes.Add(devices.Get(i)->GetNode());
  AodvHelper aodv;
  aodv.Set("EnableHello", BooleanValue(options.hello));
  aodv.Set("AllowedHelloLoss", UintegerValue(options.hello_loss));
  aodv.Set("MyRouteTimeout", TimeValue(Seconds(options.my_route)));
  InternetStackHelper internet;
  internet.SetRoutingHelper(aodv);
  internet.Install(nodes);
  Ipv4AddressHelper addresses;
  addresses.SetBase("10.0.0.0", "255.255.255.0");
  const auto interfaces = addresses.Assign(devices);
  NeighborCacheHelper().PopulateNeighborCache();  // ours has no ARP
  aodv.AssignStreams(nodes, 2000);
  return interfaces;
}

/// Packets that arrive and those that are given up are counted.
void listen(const NetDeviceContainer& devices) {
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const auto sink =
        Socket::CreateSocket(devices.Get(i)->GetNode(), UdpSocketFactory::GetTypeId());
    sink->Bind(InetSocketAddress(Ipv4Address::GetAny(), kPort));
    sink->SetRecvCallback(MakeCallback(&receive));
    devices.Get(i)->GetNode()->GetObject<Ipv4L3Protocol>()->TraceConnectWithoutContext(
        "Tx", MakeCallback(&count));
    DynamicCast<WifiNetDevice>(devices.Get(i))
        ->GetMac()
        ->TraceConnectWithoutContext("DroppedMpdu", MakeCallback(&give_up));
  }
}

std::vector<Flow> read_flows() {
  std::vector<Flow> flows;
  for (Flow flow; std::cin >> flow.source >> flow.destination >> flow.start;) flows.push_back(flow);
  sent.resize(flows.size());
  taken.resize(flows.size());
  return flows;
}

void start(const Options& options, const std::vector<Flow>& flows,
           const NetDeviceContainer& devices, const Ipv4InterfaceContainer& interfaces) {
  for (uint32_t i = 0; i < flows.size(); ++i) {
    const auto socket = Socket::CreateSocket(devices.Get(flows[i].source)->GetNode(),
                                             UdpSocketFactory::GetTypeId());
    socket->Connect(InetSocketAddress(interfaces.GetAddress(flows[i].destination), kPort));
    Simulator::Schedule(Seconds(flows[i].start), &send, socket, i, options.size,
                        Seconds(1 / options.rate), Seconds(options.stop));
  }
}

void print(const Options& options, const std::vector<Flow>& flows) {
  std::sort(delays.begin(), delays.end());
  std::size_t total = 0;
  for (const auto& flow : sent) total += flow.size();
  std::cout << options.seed << ',' << total << ',' << delays.size() << ','
            << static_cast<double>(delays.size()) / static_cast<double>(total) << ','
            << quantile(0.5) << ',' << quantile(0.95) << ',' << counts.hellos << ',' << counts.rreq
            << ',' << counts.rreq_relayed << ',' << counts.rrep << ',' << counts.rerr << ','
            << counts.data << ',' << counts.given_up << std::endl;
  for (std::size_t i = 0; options.per_flow && i < flows.size(); ++i) {
    std::cout << "# " << flows[i].source << " to " << flows[i].destination << ": "
              << std::count(taken[i].begin(), taken[i].end(), true) << " of " << sent[i].size()
              << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  RngSeedManager::SetRun(options.seed);
  const auto devices = grid(options);
  const auto interfaces = install(options, devices);
  const auto flows = read_flows();
  listen(devices);
  start(options, flows, devices, interfaces);
  Simulator::Stop(Seconds(options.stop + 15));
  Simulator::Run();
  print(options, flows);
  Simulator::Destroy();
}
