// Saturated flows between stations on a line, unicast; prints a line of CSV for each flow; --header
// prints the columns.
//   hidden_three  the receiver, a sender at 5 m, and two at 40 m on either side that do not hear
//                 each other: each sends to the receiver
//   chain         five stations 40 m apart, each sends to the next
// Log-distance, exponent 3.
#include <iostream>

#include "wifi.h"

using namespace ns3;

namespace {

struct Flow {
  uint32_t from, to;
  double bytes = 0;
};

struct Cell {
  std::vector<double> places;  // m
  std::vector<Flow> flows;
};

Cell cell_of(const std::string& name) {
  if (name == "hidden_three") return {{0, 5, 40, -40}, {{1, 0}, {2, 0}, {3, 0}}};
  return {{0, 40, 80, 120, 160}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}}};
}

void fill(Ptr<WifiNetDevice> device, Address to, uint32_t size) {
  const auto queue = device->GetMac()->GetTxop()->GetWifiMacQueue();
  while (queue->GetNPackets() < 60) device->Send(Create<Packet>(size), to, peer::kEthertype);
  Simulator::Schedule(MilliSeconds(5), &fill, device, to, size);
}

Cell cell;

/// Each station is the receiver of one flow at most, except the one of hidden_three.
bool on_received(Ptr<NetDevice> device, Ptr<const Packet> packet, uint16_t, const Address& from) {
  for (Flow& flow : cell.flows) {
    const auto node = device->GetNode();
    const bool is_it = flow.to == node->GetId() &&
                       NodeList::GetNode(flow.from)->GetDevice(0)->GetAddress() == from;
    if (is_it) flow.bytes += packet->GetSize();
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  peer::Radio radio;
  std::string name = "hidden_three";
  unsigned size = 1000, seed = 1;
  double seconds = 10;
  bool header = false;
  CommandLine line;
  radio.add_to(line);
  line.AddValue("cell", "hidden_three, chain", name);
  line.AddValue("size", "payload, bytes", size);
  line.AddValue("seed", "run number", seed);
  line.AddValue("seconds", "measured, from the start", seconds);
  line.AddValue("header", "print the columns", header);
  line.Parse(argc, argv);
  if (header) {
    std::cout << "cell,data,control,slot_us,size,seed,seconds,flow,goodput_mbps\n";
    return 0;
  }
  RngSeedManager::SetRun(seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100)));
  cell = cell_of(name);
  std::vector<Vector> places;
  for (const double x : cell.places) places.emplace_back(x, 0, 1.5);
  const NetDeviceContainer devices = peer::stations(radio, places, peer::log_distance());
  for (uint32_t i = 0; i < devices.GetN(); ++i)
    devices.Get(i)->SetReceiveCallback(MakeCallback(&on_received));
  for (uint32_t i = 0; i < cell.flows.size(); ++i) {
    const Flow& flow = cell.flows[i];
    const auto device = DynamicCast<WifiNetDevice>(devices.Get(flow.from));
    Simulator::Schedule(MicroSeconds(10 * (i + 1)), &fill, device,
                        devices.Get(flow.to)->GetAddress(), size);
  }
  Simulator::Stop(Seconds(seconds));
  Simulator::Run();
  for (std::size_t i = 0; i < cell.flows.size(); ++i)
    std::cout << name << ',' << radio.data << ',' << radio.control << ',' << radio.slot << ','
              << size << ',' << seed << ',' << seconds << ',' << i << ','
              << cell.flows[i].bytes * 8e-6 / seconds << std::endl;
  Simulator::Destroy();
}
