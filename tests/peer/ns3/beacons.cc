// Stations that broadcast periodically. Reads from standard input a line for each: x, y (m) and
// phase (s). Prints one line of CSV: beacons sent, received, received per sent.
#include <iostream>

#include "wifi.h"

using namespace ns3;

namespace {

uint64_t sent = 0, received = 0;

void beacon(Ptr<NetDevice> device, unsigned size, Time period) {
  device->Send(Create<Packet>(size), device->GetBroadcast(), peer::kEthertype);
  ++sent;
  Simulator::Schedule(period, &beacon, device, size, period);
}

}  // namespace

int main(int argc, char** argv) {
  peer::Radio radio;
  unsigned size = 64, seed = 1;
  double period = 0.1, seconds = 5;
  CommandLine line;
  radio.add_to(line);
  line.AddValue("size", "payload, bytes", size);
  line.AddValue("period", "s", period);
  line.AddValue("seconds", "simulated", seconds);
  line.AddValue("seed", "run number", seed);
  line.Parse(argc, argv);
  RngSeedManager::SetRun(seed);
  std::vector<Vector> places;
  std::vector<double> phases;
  for (double x, y, phase; std::cin >> x >> y >> phase;) {
    places.emplace_back(x, y, 1.5);
    phases.push_back(phase);
  }
  const auto devices = peer::stations(radio, places, peer::log_distance());
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    devices.Get(i)->SetReceiveCallback(
        MakeCallback(+[](Ptr<NetDevice>, Ptr<const Packet>, uint16_t, const Address&) {
          ++received;
          return true;
        }));
    Simulator::Schedule(Seconds(phases[i]), &beacon, devices.Get(i), size, Seconds(period));
  }
  Simulator::Stop(Seconds(seconds));
  Simulator::Run();
  std::cout << places.size() << ',' << seed << ',' << seconds << ',' << sent << ',' << received
            << ',' << static_cast<double>(received) / static_cast<double>(sent) << std::endl;
  Simulator::Destroy();
}
