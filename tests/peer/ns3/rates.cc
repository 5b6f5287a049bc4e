// A saturated sender and its receiver, unicast, with rate control: --manager. Prints one line of
// CSV;
// --header prints the columns; --modes prints how many data frames went out in each mode.
// Log-distance, exponent 3. Attributes of a manager are arguments, too:
// --ns3::MinstrelWifiManager::LookAroundRate=1
#include <iostream>
#include <map>

#include "wifi.h"

using namespace ns3;

namespace {

double bytes = 0;
bool is_on = false;
std::map<std::string, unsigned> sent;

void fill(Ptr<WifiNetDevice> device, Address to, uint32_t size) {
  const auto queue = device->GetMac()->GetTxop()->GetWifiMacQueue();
  while (queue->GetNPackets() < 60) device->Send(Create<Packet>(size), to, peer::kEthertype);
  Simulator::Schedule(MilliSeconds(5), &fill, device, to, size);
}

void on_sent(Ptr<const Packet> frame, uint16_t, WifiTxVector vector, MpduInfo, uint16_t) {
  if (is_on && frame->GetSize() > 60) ++sent[vector.GetMode().GetUniqueName()];
}

}  // namespace

int main(int argc, char** argv) {
  peer::Radio radio;
  unsigned size = 1500, seed = 1;
  double distance = 15, seconds = 10;
  bool header = false, modes = false;
  std::string label = "stock";
  CommandLine line;
  radio.add_to(line);
  line.AddValue("size", "payload, bytes", size);
  line.AddValue("seed", "run number", seed);
  line.AddValue("distance", "m", distance);
  line.AddValue("seconds", "measured, after 1 s", seconds);
  line.AddValue("header", "print the columns", header);
  line.AddValue("modes", "print the modes of data frames", modes);
  line.AddValue("label", "of what was changed in the peer", label);
  line.Parse(argc, argv);
  if (header) {
    std::cout << "phy,manager,peer,control,slot_us,size,distance_m,seed,seconds,goodput_mbps\n";
    return 0;
  }
  RngSeedManager::SetRun(seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100)));
  const NetDeviceContainer devices =
      peer::stations(radio, {Vector(0, 0, 1.5), Vector(distance, 0, 1.5)}, peer::log_distance());
  devices.Get(1)->SetReceiveCallback(
      MakeCallback(+[](Ptr<NetDevice>, Ptr<const Packet> packet, uint16_t, const Address&) {
        bytes += is_on ? packet->GetSize() : 0;
        return true;
      }));
  const auto device = DynamicCast<WifiNetDevice>(devices.Get(0));
  device->GetPhy()->TraceConnectWithoutContext("MonitorSnifferTx", MakeCallback(&on_sent));
  Simulator::Schedule(MicroSeconds(10), &fill, device, devices.Get(1)->GetAddress(), size);
  Simulator::Schedule(
      Seconds(1), +[] { is_on = true; });
  Simulator::Stop(Seconds(1 + seconds));
  Simulator::Run();
  std::cout << radio.data[0] << ',' << radio.manager << ',' << label << ',' << radio.control << ','
            << radio.slot << ',' << size << ',' << distance << ',' << seed << ',' << seconds << ','
            << bytes * 8e-6 / seconds << std::endl;
  if (modes)
    for (const auto& [name, count] : sent) std::cerr << name << ' ' << count << '\n';
  Simulator::Destroy();
}
