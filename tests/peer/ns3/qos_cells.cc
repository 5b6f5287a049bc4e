// Cells of 802.11n, ac or ax (or g with QoS), ad hoc: stations of three access categories on a
// circle round their receiver, saturated or, voice, with packets at a rate. Prints a line of CSV
// for each category; --header prints the columns, --air every frame on the air (to the error
// stream). Two differences from the standard can be removed: --restart, --unordered.
#include <algorithm>
#include <iostream>
#include <map>
#include <set>
#include <tuple>

#include "ns3/ampdu-subframe-header.h"
#include "ns3/channel-access-manager.h"
#include "ns3/llc-snap-header.h"
#include "ns3/wifi-mac-trailer.h"
#include "ns3/wifi-phy-state-helper.h"
#include "wifi.h"

using namespace ns3;

namespace {

struct Options {
  std::string phy = "ac";
  double band = 5, vo_rate = 0, warm = 0.5, seconds = 4, loss = 0, txop_be = -1, txop_vi = -1,
         txop_vo = -1, radius = 5, preamble = 4;
  unsigned width = 20, guard = 800, mcs = 7, streams = 1, ampdu = 0, amsdu = 0, be = 1, vi = 0,
           vo = 0, size = 1500, vo_size = 1500, seed = 1;
  bool header = false, air = false, restart = false, unordered = false;
};
Options options;

struct Source {
  Ptr<WifiNetDevice> device;
  AcIndex category = AC_BE;
  uint8_t priority = 0;
  unsigned size = 0;
  double rate = 0;
  unsigned sent = 0;
};
std::vector<Source> sources;
Address receiver;

struct Counts {
  double bytes = 0;
  std::vector<double> delays;  // s
  unsigned attempts = 0;       // PPDUs of data
  unsigned timeouts = 0;
  unsigned guard = 0;  // ns, of the last
};
std::map<AcIndex, Counts> counts;

bool is_measured() { return Simulator::Now().GetSeconds() >= options.warm; }

// How a packet begins.
struct Mark {
  int64_t sent = 0;  // ns
  uint32_t source = 0, number = 0;
  bool operator<(const Mark& other) const {
    return std::tie(source, number) < std::tie(other.source, other.number);
  }
};

void send(size_t index) {
  Source& source = sources[index];
  std::vector<uint8_t> bytes(source.size);
  const Mark mark{Simulator::Now().GetNanoSeconds(), uint32_t(index), source.sent++};
  std::memcpy(bytes.data(), &mark, sizeof mark);
  const auto packet = Create<Packet>(bytes.data(), bytes.size());
  SocketPriorityTag tag;
  tag.SetPriority(source.priority);
  packet->AddPacketTag(tag);
  source.device->Send(packet, receiver, peer::kEthertype);
}

void fill(size_t index) {
  const auto queue =
      sources[index].device->GetMac()->GetQosTxop(sources[index].category)->GetWifiMacQueue();
  while (queue->GetNPackets() < 600) send(index);
  Simulator::Schedule(MilliSeconds(2), &fill, index);
}

void tick(size_t index) {
  send(index);
  Simulator::Schedule(NanoSeconds(std::llround(1e9 / sources[index].rate)), &tick, index);
}

Mark mark_of(Ptr<const Packet> packet) {
  Mark mark;
  packet->CopyData(reinterpret_cast<uint8_t*>(&mark), sizeof mark);
  return mark;
}

void count(Ptr<const Packet> packet) {
  const Mark mark = mark_of(packet);
  Counts& of = counts[sources.at(mark.source).category];
  of.bytes += packet->GetSize();
  of.delays.push_back((Simulator::Now().GetNanoSeconds() - mark.sent) * 1e-9);
}

bool on_received(Ptr<NetDevice>, Ptr<const Packet> packet, uint16_t protocol, const Address&) {
  if (protocol == peer::kEthertype && is_measured() && !options.unordered) count(packet);
  return true;
}

// --unordered: an MPDU at the receiver, before the reorder buffer.
void on_heard(Ptr<const Packet> frame, MpduInfo part) {
  const Ptr<Packet> copy = frame->Copy();
  AmpduSubframeHeader delimiter;
  if (part.type != NORMAL_MPDU) copy->RemoveHeader(delimiter);
  WifiMacHeader header;
  copy->RemoveHeader(header);
  if (!header.IsQosData() || header.GetAddr1() != receiver || !is_measured()) return;
  WifiMacTrailer fcs;
  copy->RemoveTrailer(fcs);
  LlcSnapHeader llc;
  copy->RemoveHeader(llc);
  static std::set<Mark> heard;
  if (heard.insert(mark_of(copy)).second) count(copy);
}

// Nodes are numbered from the receiver, 0.
void on_sent(uint32_t node, Ptr<const Packet> frame, WifiTxVector vector, MpduInfo part) {
  const Ptr<Packet> copy = frame->Copy();
  AmpduSubframeHeader delimiter;
  if (part.type != NORMAL_MPDU) copy->RemoveHeader(delimiter);
  WifiMacHeader header;
  copy->PeekHeader(header);
  const bool is_first =
      part.type != MIDDLE_MPDU_IN_AGGREGATE && part.type != LAST_MPDU_IN_AGGREGATE;
  if (node > 0 && header.IsQosData() && is_first && is_measured()) {
    Counts& of = counts[sources[node - 1].category];
    ++of.attempts;
    of.guard = vector.GetGuardInterval();
  }
  if (options.air) {
    std::cerr << Simulator::Now().GetNanoSeconds() << ' ' << node << ' ' << header.GetTypeString()
              << ' ' << frame->GetSize() << ' ' << vector.GetMode().GetUniqueName() << " x"
              << unsigned(vector.GetNss()) << ' ' << vector.GetChannelWidth() << ' '
              << vector.GetGuardInterval() << ' ' << header.GetDuration().GetMicroSeconds() << '\n';
  }
}

NodeContainer nodes() {
  const unsigned senders = options.be + options.vi + options.vo;
  NodeContainer nodes;
  nodes.Create(senders + 1);
  const auto places = CreateObject<ListPositionAllocator>();
  places->Add(Vector(0, 0, 1.5));
  for (unsigned i = 0; i < senders; ++i) {
    const double angle = 2 * M_PI * i / senders;
    places->Add(Vector(options.radius * std::cos(angle), options.radius * std::sin(angle), 1.5));
  }
  MobilityHelper mobility;
  mobility.SetPositionAllocator(places);
  mobility.Install(nodes);
  return nodes;
}

void set_phy(YansWifiPhyHelper& phy) {
  const auto channel = CreateObject<YansWifiChannel>();
  channel->SetPropagationLossModel(peer::log_distance());
  channel->SetPropagationDelayModel(CreateObject<ConstantSpeedPropagationDelayModel>());
  phy.SetChannel(channel);
  phy.SetErrorRateModel("ns3::NistErrorRateModel");
  phy.Set("TxPowerStart", DoubleValue(16.0206));
  phy.Set("TxPowerEnd", DoubleValue(16.0206));
  phy.Set("Antennas", UintegerValue(options.streams));
  phy.Set("MaxSupportedTxSpatialStreams", UintegerValue(options.streams));
  phy.Set("MaxSupportedRxSpatialStreams", UintegerValue(options.streams));
  if (options.phy == "g") return;
  const bool is_5ghz = options.band == 5;
  const std::map<unsigned, std::string> in_5ghz{{20, "36"}, {40, "38"}, {80, "42"}};
  const std::string number = is_5ghz ? in_5ghz.at(options.width) : options.width == 40 ? "3" : "1";
  phy.Set("ChannelSettings", StringValue("{" + number + ", " + std::to_string(options.width) +
                                         (is_5ghz ? ", BAND_5GHZ, 0}" : ", BAND_2_4GHZ, 0}")));
}

void set_modes(WifiHelper& wifi) {
  const std::map<std::string, WifiStandard> standards{{"g", WIFI_STANDARD_80211g},
                                                      {"n", WIFI_STANDARD_80211n},
                                                      {"ac", WIFI_STANDARD_80211ac},
                                                      {"ax", WIFI_STANDARD_80211ax}};
  wifi.SetStandard(standards.at(options.phy));
  const std::map<std::string, std::string> kinds{{"n", "HtMcs"}, {"ac", "VhtMcs"}, {"ax", "HeMcs"}};
  const unsigned mcs = options.mcs + (options.phy == "n" ? 8 * (options.streams - 1) : 0);
  const std::string data =
      options.phy == "g" ? "ErpOfdmRate54Mbps" : kinds.at(options.phy) + std::to_string(mcs);
  wifi.SetRemoteStationManager(
      "ns3::ConstantRateWifiManager", "DataMode", StringValue(data), "ControlMode",
      StringValue(options.band == 5 ? "OfdmRate24Mbps" : "ErpOfdmRate24Mbps"), "RtsCtsThreshold",
      UintegerValue(4692480));
}

void set_limits(Ptr<WifiMac> mac) {
  for (const std::string category : {"BE", "BK", "VI", "VO"}) {
    mac->SetAttribute(category + "_MaxAmpduSize", UintegerValue(options.ampdu));
    mac->SetAttribute(category + "_MaxAmsduSize", UintegerValue(options.amsdu));
  }
  const std::map<AcIndex, double> limits{
      {AC_BE, options.txop_be}, {AC_VI, options.txop_vi}, {AC_VO, options.txop_vo}};
  for (const auto& [category, limit] : limits) {
    if (limit >= 0) mac->GetQosTxop(category)->SetTxopLimit(MicroSeconds(std::llround(limit)));
  }
}

// --restart: when a right frame ends an EIFS, ns-3.37 counts slots from then on, but leaves the
// timer of the access as it was, and so sends no earlier than if the EIFS had gone on.
void restart_access_after_right_frames(Ptr<WifiNetDevice> device) {
  const Ptr<ChannelAccessManager> access = device->GetMac()->GetChannelAccessManager(0);
  device->GetPhy()->GetState()->TraceConnectWithoutContext(
      "RxOk", Callback<void, Ptr<const Packet>, double, WifiMode, WifiPreamble>(
                  [access](Ptr<const Packet>, double, WifiMode, WifiPreamble) {
                    Simulator::ScheduleNow(&ChannelAccessManager::DoRestartAccessTimeoutIfNeeded,
                                           access);
                  }));
}

void set_up(Ptr<WifiNetDevice> device) {
  device->GetPhy()->SetSlot(MicroSeconds(9));
  device->GetPhy()->SetPifs(device->GetPhy()->GetSifs() + MicroSeconds(9));
  set_limits(device->GetMac());
  if (options.phy == "n" || options.phy == "ac") {
    device->GetHtConfiguration()->SetShortGuardIntervalSupported(options.guard == 400);
  } else if (options.phy == "ax") {
    device->GetHeConfiguration()->SetGuardInterval(NanoSeconds(options.guard));
  }
  if (options.restart) restart_access_after_right_frames(device);
  const uint32_t node = device->GetNode()->GetId();
  device->GetPhy()->TraceConnectWithoutContext(
      "MonitorSnifferTx",
      Callback<void, Ptr<const Packet>, uint16_t, WifiTxVector, MpduInfo, uint16_t>(
          [node](Ptr<const Packet> frame, uint16_t, WifiTxVector vector, MpduInfo part, uint16_t) {
            on_sent(node, frame, vector, part);
          }));
}

void add_source(Ptr<WifiNetDevice> device) {
  const unsigned i = sources.size();
  Source one{device, AC_BE, 0, options.size, 0};
  if (i >= options.be + options.vi) {
    one = {device, AC_VO, 6, options.vo_size, options.vo_rate};
  } else if (i >= options.be) {
    one = {device, AC_VI, 5, options.size, 0};
  }
  sources.push_back(one);
  const AcIndex category = one.category;
  device->GetRemoteStationManager()->TraceConnectWithoutContext(
      "MacTxDataFailed", Callback<void, Mac48Address>([category](Mac48Address) {
        counts[category].timeouts += is_measured();
      }));
}

void parse(int argc, char** argv) {
  CommandLine line;
  line.AddValue("phy", "g, n, ac, ax", options.phy);
  line.AddValue("band", "2.4 or 5", options.band);
  line.AddValue("width", "MHz", options.width);
  line.AddValue("guard", "interval, ns", options.guard);
  line.AddValue("mcs", "of each stream", options.mcs);
  line.AddValue("streams", "spatial", options.streams);
  line.AddValue("ampdu", "most bytes", options.ampdu);
  line.AddValue("amsdu", "most bytes", options.amsdu);
  line.AddValue("be", "stations of best effort", options.be);
  line.AddValue("vi", "of video", options.vi);
  line.AddValue("vo", "of voice", options.vo);
  line.AddValue("size", "payload, bytes", options.size);
  line.AddValue("vo_size", "payload of voice, bytes", options.vo_size);
  line.AddValue("vo_rate", "Hz; 0: saturated", options.vo_rate);
  line.AddValue("txop_be", "limit, us; below 0: stock", options.txop_be);
  line.AddValue("txop_vi", "limit, us", options.txop_vi);
  line.AddValue("txop_vo", "limit, us", options.txop_vo);
  line.AddValue("radius", "of the circle, m", options.radius);
  line.AddValue("preamble", "lowest SNR of the preamble detector, dB", options.preamble);
  line.AddValue("loss", "of MPDUs at the receiver", options.loss);
  line.AddValue("restart", "access timers after right frames", options.restart);
  line.AddValue("unordered", "count before the reorder buffer", options.unordered);
  line.AddValue("seed", "run number", options.seed);
  line.AddValue("warm", "s before it measures", options.warm);
  line.AddValue("seconds", "measured", options.seconds);
  line.AddValue("header", "print the columns", options.header);
  line.AddValue("air", "print every frame", options.air);
  line.Parse(argc, argv);
}

void print() {
  const std::map<AcIndex, const char*> names{{AC_BE, "BE"}, {AC_VI, "VI"}, {AC_VO, "VO"}};
  for (auto& [category, of] : counts) {
    std::sort(of.delays.begin(), of.delays.end());
    double sum = 0;
    for (const double delay : of.delays) sum += delay;
    const size_t n = of.delays.size();
    const Options& o = options;
    std::cout << o.phy << ',' << o.band << ',' << o.width << ',' << of.guard << ',' << o.mcs << ','
              << o.streams << ',' << o.ampdu << ',' << o.amsdu << ',' << o.size << ',' << o.vo_size
              << ',' << o.be << ',' << o.vi << ',' << o.vo << ',' << o.vo_rate << ',' << o.txop_be
              << ',' << o.txop_vi << ',' << o.txop_vo << ',' << o.radius << ',' << o.preamble << ','
              << o.loss << ',' << o.seed << ',' << o.seconds << ',' << names.at(category) << ','
              << of.bytes * 8e-6 / o.seconds << ',' << n << ',' << (n ? 1e3 * sum / n : -1) << ','
              << (n ? 1e3 * of.delays[n * 95 / 100] : -1) << ',' << of.attempts << ','
              << of.timeouts << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  parse(argc, argv);
  if (options.header) {
    std::cout << "phy,band_ghz,width_mhz,gi_ns,mcs,streams,max_ampdu,max_amsdu,payload_be,"
                 "payload_vo,n_be,n_vi,n_vo,vo_rate_hz,txop_be_us,txop_vi_us,txop_vo_us,radius_m,"
                 "preamble_db,post_loss,seed,seconds,ac,goodput_mbps,received,mean_delay_ms,p95_"
                 "delay_ms,attempts,failed\n";
    return 0;
  }
  RngSeedManager::SetRun(options.seed);
  Config::SetDefault("ns3::WifiMacQueue::MaxDelay", TimeValue(Seconds(100)));
  Config::SetDefault("ns3::WifiMacQueue::MaxSize", QueueSizeValue(QueueSize("2000p")));
  Config::SetDefault("ns3::ThresholdPreambleDetectionModel::Threshold",
                     DoubleValue(options.preamble));
  YansWifiPhyHelper phy;
  set_phy(phy);
  WifiHelper wifi;
  set_modes(wifi);
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac", "QosSupported", BooleanValue(true));
  const auto devices = wifi.Install(phy, mac, nodes());
  wifi.AssignStreams(devices, 1000);
  receiver = devices.Get(0)->GetAddress();
  devices.Get(0)->SetReceiveCallback(MakeCallback(&on_received));
  if (options.unordered) {
    DynamicCast<WifiNetDevice>(devices.Get(0))
        ->GetPhy()
        ->TraceConnectWithoutContext(
            "MonitorSnifferRx",
            Callback<void, Ptr<const Packet>, uint16_t, WifiTxVector, MpduInfo, SignalNoiseDbm,
                     uint16_t>([](Ptr<const Packet> frame, uint16_t, WifiTxVector, MpduInfo part,
                                  SignalNoiseDbm, uint16_t) { on_heard(frame, part); }));
  }
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const auto device = DynamicCast<WifiNetDevice>(devices.Get(i));
    set_up(device);
    if (i > 0) add_source(device);
  }
  if (options.loss > 0) {
    const auto errors = CreateObject<RateErrorModel>();
    errors->SetUnit(RateErrorModel::ERROR_UNIT_PACKET);
    errors->SetRate(options.loss);
    errors->AssignStreams(5000);
    DynamicCast<WifiNetDevice>(devices.Get(0))->GetPhy()->SetPostReceptionErrorModel(errors);
  }
  for (size_t i = 0; i < sources.size(); ++i) {
    if (sources[i].rate > 0) {
      Simulator::Schedule(Seconds(0.1 + double(i) / sources.size() / sources[i].rate), &tick, i);
    } else {
      Simulator::Schedule(MicroSeconds(10 * (i + 1)), &fill, i);
    }
  }
  Simulator::Stop(Seconds(options.warm + options.seconds));
  Simulator::Run();
  print();
  Simulator::Destroy();
}
