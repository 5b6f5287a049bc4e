// AODV of ns-3 on the base field of AntHocNet (docs/scenarios/anthocnet_base_field.md): 50 stations
// on random waypoint paths in 1500 x 300 m, 20 flows of 64 bytes a second that begin at random in
// the first --window seconds, 802.11b at 2 Mb/s, 300 m. With its defaults it is what the benchmark
// runs whose figures that page quotes. Prints one line of CSV: the words of tests/validation/
// record_field.py. Lost packets of data are sorted by what was seen of them last: given up by the
// MAC, too old in its queue, dropped by ARP, out of hops, without a route, or nothing.
#include <iostream>

#include "aodv_stations.h"
#include "wifi.h"

using namespace ns3;

namespace {

constexpr uint32_t kStations = 50, kFlows = 20;
constexpr double kRange = 300;  // m

struct Options {
  unsigned seed = 1;
  double stop = 120, window = 60, speed_low = 1, speed_high = 20, pause = 30;
  std::string loss = "range", data = "DsssRate2Mbps", broadcast = "DsssRate2Mbps";
  bool fixed_rate = true, again = false;
  peer::Stack stack;
};

Options options_of(int argc, char** argv) {
  Options options;
  CommandLine line;
  line.AddValue("seed", "run number", options.seed);
  line.AddValue("stop", "end of the run, s", options.stop);
  line.AddValue("window", "flows begin in these first seconds", options.window);
  line.AddValue("speed_low", "m/s", options.speed_low);
  line.AddValue("speed_high", "m/s", options.speed_high);
  line.AddValue("pause", "s", options.pause);
  line.AddValue("loss", "range or two_ray", options.loss);
  line.AddValue("data", "mode of data", options.data);
  line.AddValue("broadcast", "mode of broadcasts", options.broadcast);
  line.AddValue("fixed_rate", "0: ns-3's default station manager", options.fixed_rate);
  line.AddValue("again", "print how many frames went to stations known to be lost", options.again);
  options.stack.add_to(line);
  line.Parse(argc, argv);
  return options;
}

Ptr<UniformRandomVariable> uniform(double low, double high) {
  const auto one = CreateObject<UniformRandomVariable>();
  one->SetAttribute("Min", DoubleValue(low));
  one->SetAttribute("Max", DoubleValue(high));
  return one;
}

void move(const Options& options, const NodeContainer& nodes) {
  const auto places = CreateObject<RandomRectanglePositionAllocator>();
  places->SetX(uniform(0, 1500));
  places->SetY(uniform(0, 300));
  places->AssignStreams(50000);
  std::ostringstream speed, pause;
  speed << "ns3::UniformRandomVariable[Min=" << options.speed_low << "|Max=" << options.speed_high
        << "]";
  pause << "ns3::ConstantRandomVariable[Constant=" << options.pause << "]";
  MobilityHelper mobility;
  mobility.SetPositionAllocator(places);
  mobility.SetMobilityModel("ns3::RandomWaypointMobilityModel", "Speed", StringValue(speed.str()),
                            "Pause", StringValue(pause.str()), "PositionAllocator",
                            PointerValue(places));
  mobility.Install(nodes);
  mobility.AssignStreams(nodes, 60000);
}

NetDeviceContainer radios(const Options& options, const NodeContainer& nodes) {
  YansWifiChannelHelper channel;
  channel.SetPropagationDelay("ns3::ConstantSpeedPropagationDelayModel");
  YansWifiPhyHelper phy;
  if (options.loss == "two_ray") {
    channel.AddPropagationLoss("ns3::TwoRayGroundPropagationLossModel", "Frequency",
                               DoubleValue(2.412e9), "HeightAboveZ", DoubleValue(1.5));
    phy.Set("TxPowerStart", DoubleValue(10.04));  // -82 dBm at 300 m
    phy.Set("TxPowerEnd", DoubleValue(10.04));
  } else {
    channel.AddPropagationLoss("ns3::RangePropagationLossModel", "MaxRange", DoubleValue(kRange));
  }
  phy.SetChannel(channel.Create());
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac");
  WifiHelper wifi;
  wifi.SetStandard(WIFI_STANDARD_80211b);
  if (options.fixed_rate) {
    wifi.SetRemoteStationManager(
        "ns3::ConstantRateWifiManager", "DataMode", StringValue(options.data), "ControlMode",
        StringValue(options.data), "NonUnicastMode", StringValue(options.broadcast));
  }
  const auto devices = wifi.Install(phy, mac, nodes);
  wifi.AssignStreams(devices, 1000);
  return devices;
}

std::vector<peer::Flow> flows_of(const Options& options) {
  const auto start = uniform(0, options.window);
  start->SetStream(70000);
  std::vector<peer::Flow> flows;
  for (uint32_t i = 0; i < kFlows; ++i) flows.push_back({i, kStations - 1 - i, start->GetValue()});
  return flows;
}

void print(const Options& options) {
  peer::Tally& tally = peer::tally();
  const peer::Counts& counts = tally.counts;
  const auto ended = [&](peer::Fate fate) { return tally.ended(fate); };
  std::cout << options.seed << ',' << tally.sent() << ',' << tally.delays.size() << ','
            << tally.mean() << ',' << tally.quantile(0.5) << ',' << tally.quantile(0.99) << ','
            << counts.hellos << ',' << counts.rreq << ',' << counts.rreq_relayed << ','
            << counts.rrep << ',' << counts.rerr << ',' << counts.data << ',' << counts.given_up
            << ',' << counts.given_up_data << ',' << counts.given_up_beyond << ','
            << ended(peer::Fate::kGivenUp) << ',' << ended(peer::Fate::kExpired) << ','
            << ended(peer::Fate::kArp) << ',' << ended(peer::Fate::kTtl) << ','
            << ended(peer::Fate::kNoRoute) << ',' << ended(peer::Fate::kNone) << std::endl;
  if (options.again) {
    std::cout << "# of " << counts.given_up_data << " frames of data that were given up, "
              << counts.given_up_again << " within 3 s of another one on that link" << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  RngSeedManager::SetRun(options.seed);
  NodeContainer nodes;
  nodes.Create(kStations);
  move(options, nodes);
  const auto devices = radios(options, nodes);
  const auto interfaces = peer::install(options.stack, devices);
  peer::Load load;
  load.rate = 1;
  load.stop = options.stop - 1;
  peer::tally().counts.range = kRange;
  peer::listen(devices, load.size);
  peer::start(load, flows_of(options), devices, interfaces);
  Simulator::Stop(Seconds(options.stop));
  Simulator::Run();
  print(options);
  Simulator::Destroy();
}
