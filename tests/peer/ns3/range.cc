// Broadcasts over a distance: the share that arrives. Prints one line of CSV.
#include <iostream>

#include "wifi.h"

using namespace ns3;

int main(int argc, char** argv) {
  peer::Radio radio;
  unsigned size = 100, frames = 4000, seed = 1;
  double distance = 50;
  CommandLine line;
  radio.add_to(line);
  line.AddValue("size", "payload, bytes", size);
  line.AddValue("frames", "sent", frames);
  line.AddValue("seed", "run number", seed);
  line.AddValue("distance", "m", distance);
  line.Parse(argc, argv);
  radio.broadcast = radio.data;
  RngSeedManager::SetRun(seed);
  const auto devices =
      peer::stations(radio, {Vector(0, 0, 1.5), Vector(distance, 0, 1.5)}, peer::log_distance());
  static unsigned received = 0;
  devices.Get(1)->SetReceiveCallback(
      MakeCallback(+[](Ptr<NetDevice>, Ptr<const Packet>, uint16_t, const Address&) {
        ++received;
        return true;
      }));
  const auto sender = devices.Get(0);
  for (unsigned i = 0; i < frames; ++i) {
    Simulator::Schedule(MilliSeconds(10 * (i + 1)), [sender, size] {
      sender->Send(Create<Packet>(size), sender->GetBroadcast(), peer::kEthertype);
    });
  }
  Simulator::Stop(MilliSeconds(10 * (frames + 2)));
  Simulator::Run();
  std::cout << radio.data << ',' << radio.detector << ',' << size << ',' << distance << ','
            << frames << ',' << static_cast<double>(received) / frames << std::endl;
  Simulator::Destroy();
}
