// A saturated sender of 802.11n or ac and its receiver, unicast, ad hoc, with rate control. Prints
// one line of CSV; --header prints the columns; --modes prints how many PPDUs and MPDUs of data went
// out in each mode. Log-distance, exponent 3. One spatial stream, no preamble detector, A-MPDU up to
// the class's maximum. Attributes of a manager are arguments, too:
// --ns3::MinstrelHtWifiManager::LookAroundRate=1
#include <iostream>
#include <map>

#include "wifi.h"

using namespace ns3;

namespace {

struct Options {
  std::string phy = "n", manager = "minstrel_ht", label = "stock";
  unsigned width = 20, mcs = 0, size = 1500, seed = 1, ampdu = 65535;
  double distance = 5, warm = 3, seconds = 5;
  bool short_guard = false, header = false, modes = false;
};

struct Counts {
  bool is_on = false;
  double bytes = 0;
  std::map<std::string, std::pair<unsigned, unsigned>> sent;  ///< PPDUs and MPDUs.
};
Counts counts;

void fill(Ptr<WifiNetDevice> device, Address to, uint32_t size) {
  const auto queue = device->GetMac()->GetQosTxop(AC_BE)->GetWifiMacQueue();
  while (queue->GetNPackets() < 400) device->Send(Create<Packet>(size), to, peer::kEthertype);
  Simulator::Schedule(MilliSeconds(2), &fill, device, to, size);
}

void on_sent(Ptr<const Packet> frame, uint16_t, WifiTxVector vector, MpduInfo part, uint16_t) {
  if (!counts.is_on || frame->GetSize() < 200) return;
  auto& [ppdus, mpdus] = counts.sent[vector.GetMode().GetUniqueName() + " of " +
                                     std::to_string(vector.GetChannelWidth()) + " MHz"];
  ppdus += part.type != MIDDLE_MPDU_IN_AGGREGATE && part.type != LAST_MPDU_IN_AGGREGATE;
  ++mpdus;
}

void set_manager(const Options& options, WifiHelper& wifi, bool is_5ghz) {
  // Else an A-MPDU above 65,535 bytes has an RTS.
  Config::SetDefault("ns3::WifiRemoteStationManager::RtsCtsThreshold", UintegerValue(4692480));
  const std::string control = is_5ghz ? "OfdmRate6Mbps" : "ErpOfdmRate6Mbps";
  if (options.manager == "minstrel_ht") {
    wifi.SetRemoteStationManager("ns3::MinstrelHtWifiManager");
  } else if (options.manager == "ideal") {
    wifi.SetRemoteStationManager("ns3::IdealWifiManager");
  } else {
    const std::string kind = options.phy == "n" ? "HtMcs" : "VhtMcs";
    wifi.SetRemoteStationManager("ns3::ConstantRateWifiManager", "DataMode",
                                 StringValue(kind + std::to_string(options.mcs)), "ControlMode",
                                 StringValue(control));
  }
}

NetDeviceContainer stations(const Options& options) {
  const bool is_5ghz = options.phy == "ac";
  NodeContainer nodes;
  nodes.Create(2);
  const auto positions = CreateObject<ListPositionAllocator>();
  positions->Add(Vector(0, 0, 1.5));
  positions->Add(Vector(options.distance, 0, 1.5));
  MobilityHelper mobility;
  mobility.SetPositionAllocator(positions);
  mobility.Install(nodes);
  const auto channel = CreateObject<YansWifiChannel>();
  channel->SetPropagationLossModel(peer::log_distance());
  channel->SetPropagationDelayModel(CreateObject<ConstantSpeedPropagationDelayModel>());
  YansWifiPhyHelper phy;
  phy.SetChannel(channel);
  phy.SetErrorRateModel("ns3::NistErrorRateModel");
  phy.DisablePreambleDetectionModel();
  phy.Set("TxPowerStart", DoubleValue(16.0206));
  phy.Set("TxPowerEnd", DoubleValue(16.0206));
  const std::map<unsigned, std::string> channels{{20, "36"}, {40, "38"}, {80, "42"}};
  const std::string number = is_5ghz ? channels.at(options.width) : "1";
  phy.Set("ChannelSettings",
          StringValue("{" + number + ", " + std::to_string(options.width) +
                      (is_5ghz ? ", BAND_5GHZ, 0}" : ", BAND_2_4GHZ, 0}")));
  WifiHelper wifi;
  wifi.SetStandard(is_5ghz ? WIFI_STANDARD_80211ac : WIFI_STANDARD_80211n);
  set_manager(options, wifi, is_5ghz);
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac", "QosSupported", BooleanValue(true), "BE_MaxAmpduSize",
              UintegerValue(options.ampdu), "BE_MaxAmsduSize", UintegerValue(0));
  const auto devices = wifi.Install(phy, mac, nodes);
  for (uint32_t i = 0; i < 2; ++i) {
    const auto device = DynamicCast<WifiNetDevice>(devices.Get(i));
    device->GetPhy()->SetSlot(MicroSeconds(9));
    device->GetPhy()->SetPifs(device->GetPhy()->GetSifs() + device->GetPhy()->GetSlot());
    device->GetHtConfiguration()->SetShortGuardIntervalSupported(options.short_guard);
  }
  wifi.AssignStreams(devices, 1000);
  return devices;
}

void parse(Options& options, int argc, char** argv) {
  CommandLine line;
  line.AddValue("phy", "n: 2.4 GHz, ac: 5 GHz", options.phy);
  line.AddValue("manager", "of rates: minstrel_ht, ideal, constant", options.manager);
  line.AddValue("label", "of what was changed in the peer", options.label);
  line.AddValue("width", "MHz", options.width);
  line.AddValue("mcs", "of constant", options.mcs);
  line.AddValue("size", "payload, bytes", options.size);
  line.AddValue("ampdu", "most bytes", options.ampdu);
  line.AddValue("seed", "run number", options.seed);
  line.AddValue("distance", "m", options.distance);
  line.AddValue("warm", "s before it measures", options.warm);
  line.AddValue("seconds", "measured", options.seconds);
  line.AddValue("short", "guard interval of 400 ns, too", options.short_guard);
  line.AddValue("header", "print the columns", options.header);
  line.AddValue("modes", "print the modes of data frames", options.modes);
  line.Parse(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  parse(options, argc, argv);
  if (options.header) {
    std::cout << "phy,manager,peer,width_mhz,short_guard,mcs,max_ampdu,size,distance_m,seed,warm,"
                 "seconds,goodput_mbps\n";
    return 0;
  }
  RngSeedManager::SetRun(options.seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100)));
  Config::SetDefault("ns3::WifiMacQueue::MaxSize", QueueSizeValue(QueueSize("2000p")));
  const NetDeviceContainer devices = stations(options);
  devices.Get(1)->SetReceiveCallback(
      MakeCallback(+[](Ptr<NetDevice>, Ptr<const Packet> packet, uint16_t protocol, const Address&) {
        counts.bytes += counts.is_on && protocol == peer::kEthertype ? packet->GetSize() : 0;
        return true;
      }));
  const auto device = DynamicCast<WifiNetDevice>(devices.Get(0));
  device->GetPhy()->TraceConnectWithoutContext("MonitorSnifferTx", MakeCallback(&on_sent));
  Simulator::Schedule(MicroSeconds(10), &fill, device, devices.Get(1)->GetAddress(), options.size);
  Simulator::Schedule(
      Seconds(options.warm), +[] { counts.is_on = true; });
  Simulator::Stop(Seconds(options.warm + options.seconds));
  Simulator::Run();
  std::cout << options.phy << ',' << options.manager << ',' << options.label << ','
            << options.width << ',' << options.short_guard << ',' << options.mcs << ','
            << options.ampdu << ',' << options.size << ',' << options.distance << ','
            << options.seed << ',' << options.warm << ',' << options.seconds << ','
            << counts.bytes * 8e-6 / options.seconds << std::endl;
  if (options.modes) {
    for (const auto& [name, sent] : counts.sent) {
      std::cerr << name << ": " << sent.first << " PPDUs, " << sent.second << " MPDUs\n";
    }
  }
  Simulator::Destroy();
}
