// What the peer programs have in common: ad hoc stations of ns-3 whose rates, slot and thresholds
// are chosen on the command line. Uses ns-3's public headers only (Debian: libns3-dev, ns-3.37).
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "ns3/core-module.h"
#include "ns3/mobility-module.h"
#include "ns3/network-module.h"
#include "ns3/propagation-module.h"
#include "ns3/wifi-module.h"
#include "ns3/yans-wifi-channel.h"
#include "ns3/yans-wifi-helper.h"

namespace peer {

constexpr uint16_t kEthertype = 0x88b5;  // IEEE Std 802: local experimental

struct Radio {
  std::string data = "b11";    // b1 b2 b5.5 b11 g6 ... g54
  std::string control = "b1";  // RTS, and the only basic rate: CTS and ACK
  std::string broadcast = "b1";
  unsigned rts = 65535;    // threshold, bytes
  double slot = 20;        // us
  double power = 16.0206;  // dBm
  double energy = -62;     // CcaEdThreshold, dBm
  bool detector = true;    // of preambles: -82 dBm and 4 dB
  bool short_preamble = false;
  std::string manager = "constant";  // aarf, minstrel: of the rate of data
  bool ascending = false;            // what stations know of each other's rates: else DSSS first

  void add_to(ns3::CommandLine& line) {
    line.AddValue("data", "rate of data: b1 b2 b5.5 b11 g6 .. g54", data);
    line.AddValue("control", "rate of RTS, CTS and ACK", control);
    line.AddValue("broadcast", "rate of broadcasts", broadcast);
    line.AddValue("rts", "RTS threshold, bytes", rts);
    line.AddValue("slot", "us", slot);
    line.AddValue("power", "dBm", power);
    line.AddValue("energy", "CcaEdThreshold, dBm", energy);
    line.AddValue("detector", "of preambles", detector);
    line.AddValue("short", "preambles", short_preamble);
    line.AddValue("manager", "of rates: constant, aarf, minstrel", manager);
    line.AddValue("ascending", "rates in their order, not DSSS before OFDM", ascending);
  }
};

inline ns3::WifiMode mode(const std::string& name) {
  std::string rate = name.substr(1);
  if (const auto point = rate.find('.'); point != std::string::npos) rate[point] = '_';
  return ns3::WifiMode((name[0] == 'g' ? "ErpOfdmRate" : "DsssRate") + rate + "Mbps");
}

/// All mandatory rates of a peer that an ad hoc station of ns-3 meets become basic rates. So all
/// peers are made known before they meet, and the basic rate set has the control rate alone.
inline void fix_basic_rates(const Radio& radio, const ns3::NetDeviceContainer& devices) {
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const auto device = ns3::DynamicCast<ns3::WifiNetDevice>(devices.Get(i));
    const auto stations = device->GetRemoteStationManager();
    for (uint32_t j = 0; j < devices.GetN(); ++j) {
      if (i == j) continue;
      const auto address = ns3::Mac48Address::ConvertFrom(devices.Get(j)->GetAddress());
      auto modes = device->GetPhy()->GetModeList();
      if (radio.ascending)
        modes.sort(
            [](const auto& a, const auto& b) { return a.GetDataRate(20) < b.GetDataRate(20); });
      for (const auto& one : modes) stations->AddSupportedMode(address, one);
      if (radio.short_preamble) stations->AddSupportedPhyPreamble(address, true);
      stations->RecordDisassociated(address);
    }
    stations->AddBasicMode(mode(radio.control));
    stations->SetShortPreambleEnabled(radio.short_preamble);
  }
}

inline void set_manager(const Radio& radio, ns3::WifiHelper& wifi) {
  using namespace ns3;
  const UintegerValue rts(radio.rts);
  if (radio.manager == "aarf") {
    wifi.SetRemoteStationManager("ns3::AarfWifiManager", "RtsCtsThreshold", rts);
  } else if (radio.manager == "minstrel") {
    wifi.SetRemoteStationManager("ns3::MinstrelWifiManager", "RtsCtsThreshold", rts);
  } else {
    wifi.SetRemoteStationManager(
        "ns3::ConstantRateWifiManager", "DataMode", StringValue(mode(radio.data).GetUniqueName()),
        "ControlMode", StringValue(mode(radio.control).GetUniqueName()), "NonUnicastMode",
        StringValue(mode(radio.broadcast).GetUniqueName()), "RtsCtsThreshold", rts);
  }
}

/// Radios of nodes that have places already, on one channel.
inline ns3::NetDeviceContainer radios(const Radio& radio, const ns3::NodeContainer& nodes,
                                      ns3::Ptr<ns3::PropagationLossModel> loss) {
  using namespace ns3;
  const auto channel = CreateObject<YansWifiChannel>();
  channel->SetPropagationLossModel(loss);
  channel->SetPropagationDelayModel(CreateObject<ConstantSpeedPropagationDelayModel>());
  YansWifiPhyHelper phy;
  phy.SetChannel(channel);
  phy.SetErrorRateModel("ns3::NistErrorRateModel");
  if (!radio.detector) phy.DisablePreambleDetectionModel();
  phy.Set("TxPowerStart", DoubleValue(radio.power));
  phy.Set("TxPowerEnd", DoubleValue(radio.power));
  phy.Set("CcaEdThreshold", DoubleValue(radio.energy));
  phy.Set("ShortPlcpPreambleSupported", BooleanValue(radio.short_preamble));
  WifiMacHelper mac;
  mac.SetType("ns3::AdhocWifiMac");
  WifiHelper wifi;
  wifi.SetStandard(radio.data[0] == 'g' ? WIFI_STANDARD_80211g : WIFI_STANDARD_80211b);
  set_manager(radio, wifi);
  const NetDeviceContainer devices = wifi.Install(phy, mac, nodes);
  for (uint32_t i = 0; i < devices.GetN(); ++i) {
    const auto one = DynamicCast<WifiNetDevice>(devices.Get(i))->GetPhy();
    one->SetSlot(NanoSeconds(std::llround(radio.slot * 1000)));
    one->SetPifs(one->GetSifs() + one->GetSlot());
  }
  wifi.AssignStreams(devices, 1000);
  Simulator::ScheduleNow([radio, devices] { fix_basic_rates(radio, devices); });
  return devices;
}

/// A station at each place, on one channel.
inline ns3::NetDeviceContainer stations(const Radio& radio, const std::vector<ns3::Vector>& places,
                                        ns3::Ptr<ns3::PropagationLossModel> loss) {
  using namespace ns3;
  NodeContainer nodes;
  nodes.Create(places.size());
  const auto positions = CreateObject<ListPositionAllocator>();
  for (const Vector& place : places) positions->Add(place);
  MobilityHelper mobility;
  mobility.SetPositionAllocator(positions);
  mobility.Install(nodes);
  return radios(radio, nodes, loss);
}

inline ns3::Ptr<ns3::PropagationLossModel> friis() {
  const auto loss = ns3::CreateObject<ns3::FriisPropagationLossModel>();
  loss->SetFrequency(2.412e9);
  return loss;
}

/// 46.6777 dB at 1 m, exponent 3.
inline ns3::Ptr<ns3::PropagationLossModel> log_distance() {
  const auto loss = ns3::CreateObject<ns3::LogDistancePropagationLossModel>();
  loss->SetPathLossExponent(3);
  loss->SetReference(1, 46.6777);
  return loss;
}

}  // namespace peer
