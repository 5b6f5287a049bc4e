// Saturated senders and one receiver, unicast. Prints one line of CSV; --header prints the columns.
//   circle  n senders, `distance` m round the receiver; log-distance, exponent 3
//   line    two, d and 2 d on one side of it; Friis
//   hidden  two that do not hear each other; both arrive with `level` dBm
#include <iostream>
#include <map>

#include "wifi.h"

using namespace ns3;

namespace {

struct Counts {
  bool is_on = false;
  double received = 0, bytes = 0, acknowledged = 0, data_failed = 0, rts_failed = 0;
  double started = 0, overlapping = 0;
  Time last;
  uint32_t last_sender = 0;
  std::map<int, long> drops;
};
Counts counts;

void fill(Ptr<WifiNetDevice> device, Address to, uint32_t size) {
  const auto queue = device->GetMac()->GetTxop()->GetWifiMacQueue();
  while (queue->GetNPackets() < 60) device->Send(Create<Packet>(size), to, peer::kEthertype);
  Simulator::Schedule(MilliSeconds(5), &fill, device, to, size);
}

/// A frame with a payload starts within a slot of the other sender's.
void on_start(uint32_t sender, Time slot, Ptr<const Packet> frame) {
  if (!counts.is_on || frame->GetSize() < 60) return;
  ++counts.started;
  if (counts.started > 1 && Simulator::Now() - counts.last < slot && sender != counts.last_sender)
    counts.overlapping += 2;
  counts.last = Simulator::Now();
  counts.last_sender = sender;
}

struct Options {
  peer::Radio radio;
  std::string layout = "circle";
  unsigned n = 2, size = 1500, seed = 1;
  double distance = 5, level = -58.9794, seconds = 10;
  bool header = false, drops = false;

  Options(int argc, char** argv) {
    CommandLine line;
    radio.add_to(line);
    line.AddValue("layout", "circle, line, hidden", layout);
    line.AddValue("n", "senders", n);
    line.AddValue("size", "payload, bytes", size);
    line.AddValue("seed", "run number", seed);
    line.AddValue("distance", "m", distance);
    line.AddValue("level", "dBm, hidden", level);
    line.AddValue("seconds", "measured, after 1 s", seconds);
    line.AddValue("header", "print the columns", header);
    line.AddValue("drops", "print why senders lost frames", drops);
    line.Parse(argc, argv);
    if (layout != "circle") n = 2;
  }
};

/// The receiver's, then the senders'.
std::vector<Vector> places(const Options& options) {
  std::vector<Vector> places{Vector(0, 0, 1.5)};
  for (unsigned i = 0; i < options.n; ++i) {
    const double turn = 2 * M_PI * i / options.n;
    places.push_back(options.layout == "line"
                         ? Vector((i + 1) * options.distance, 0, 1.5)
                         : Vector(options.distance * cos(turn), options.distance * sin(turn), 1.5));
  }
  return places;
}

NetDeviceContainer stations(const Options& options) {
  Ptr<PropagationLossModel> loss = options.layout == "line" ? peer::friis() : peer::log_distance();
  const auto matrix = CreateObject<MatrixPropagationLossModel>();
  if (options.layout == "hidden") loss = matrix;
  const auto devices = peer::stations(options.radio, places(options), loss);
  const auto mobility = [&devices](unsigned i) {
    return devices.Get(i)->GetNode()->GetObject<MobilityModel>();
  };
  matrix->SetDefaultLoss(1000);
  for (unsigned i = 1; i <= options.n; ++i)
    matrix->SetLoss(mobility(0), mobility(i), options.radio.power - options.level);
  return devices;
}

void count_received(const NetDeviceContainer& devices) {
  devices.Get(0)->SetReceiveCallback(
      MakeCallback(+[](Ptr<NetDevice>, Ptr<const Packet> packet, uint16_t, const Address&) {
        counts.received += counts.is_on;
        counts.bytes += counts.is_on ? packet->GetSize() : 0;
        return true;
      }));
}

/// @param i  the sender's number, from 1 on.
void count_sent(const Ptr<WifiNetDevice>& device, unsigned i, Time slot) {
  device->GetMac()->TraceConnectWithoutContext(
      "AckedMpdu", MakeCallback(+[](Ptr<const WifiMpdu>) { counts.acknowledged += counts.is_on; }));
  const auto stations = device->GetRemoteStationManager();
  stations->TraceConnectWithoutContext(
      "MacTxDataFailed", MakeCallback(+[](Mac48Address) { counts.data_failed += counts.is_on; }));
  stations->TraceConnectWithoutContext(
      "MacTxRtsFailed", MakeCallback(+[](Mac48Address) { counts.rts_failed += counts.is_on; }));
  device->GetPhy()->TraceConnectWithoutContext(
      "PhyTxBegin", Callback<void, Ptr<const Packet>, double>(
                        [i, slot](Ptr<const Packet> frame, double) { on_start(i, slot, frame); }));
  device->GetPhy()->TraceConnectWithoutContext(
      "PhyRxDrop", MakeCallback(+[](Ptr<const Packet>, WifiPhyRxfailureReason reason) {
        counts.drops[reason] += counts.is_on;
      }));
}

void print(const Options& options) {
  const peer::Radio& radio = options.radio;
  const bool has_rts = radio.rts < options.size;
  const double failed = has_rts ? counts.rts_failed : counts.data_failed;
  const double tried = counts.acknowledged + counts.data_failed + (has_rts ? counts.rts_failed : 0);
  std::cout << options.layout << ',' << radio.data << ',' << radio.control << ',' << radio.slot
            << ',' << has_rts << ',' << radio.short_preamble << ',' << options.size << ','
            << options.n << ',' << options.distance << ',' << options.seed << ',' << options.seconds
            << ',' << counts.bytes * 8e-6 / options.seconds << ',' << failed / std::max(1.0, tried)
            << ',' << counts.started << ',' << counts.overlapping / std::max(1.0, counts.started)
            << std::endl;
  if (!options.drops) return;
  for (const auto& [reason, count] : counts.drops)
    std::cerr << static_cast<WifiPhyRxfailureReason>(reason) << ' ' << count << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const Options options(argc, argv);
  if (options.header) {
    std::cout
        << "layout,data,control,slot_us,rts,short,size,n,distance_m,seed,seconds,goodput_mbps,"
           "failure,started,overlap\n";
    return 0;
  }
  RngSeedManager::SetRun(options.seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100)));
  const NetDeviceContainer devices = stations(options);
  count_received(devices);
  for (unsigned i = 1; i <= options.n; ++i) {
    const auto device = DynamicCast<WifiNetDevice>(devices.Get(i));
    Simulator::Schedule(MicroSeconds(10 * i), &fill, device, devices.Get(0)->GetAddress(),
                        options.size);
    count_sent(device, i, MicroSeconds(options.radio.slot));
  }
  Simulator::Schedule(
      Seconds(1), +[] { counts.is_on = true; });
  Simulator::Stop(Seconds(1 + options.seconds));
  Simulator::Run();
  print(options);
  Simulator::Destroy();
}
