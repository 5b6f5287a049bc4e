#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "sim/radio/mac/codec.h"
#include "tests/support/output_of.h"
#include "tests/unit/sim/radio/bss.h"

namespace sim::radio::test {
namespace {

namespace fs = std::filesystem;

void put(std::ofstream& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out.put(static_cast<char>(value >> (8 * i)));
}

/// A pcap file (draft-ietf-opsawg-pcap) of frames behind the shortest radiotap header that says
/// that the FCS is there.
void write_pcap(const fs::path& file, const std::vector<Log::Start>& starts) {
  constexpr std::uint32_t kRadiotap = 127, kHeader = 9, kFlags = 1u << 1, kFcsAtEnd = 0x10;
  std::ofstream out(file, std::ios::binary);
  put(out, 0xa1b2c3d4, 4);
  put(out, 2, 2);
  put(out, 4, 2);
  put(out, 0, 4);
  put(out, 0, 4);
  put(out, 65535, 4);
  put(out, kRadiotap, 4);
  for (const Log::Start& start : starts) {
    const hal::Bytes bytes = encode(start.frame);
    const auto us = std::chrono::floor<std::chrono::microseconds>(start.at.time_since_epoch());
    put(out, static_cast<std::uint32_t>(us.count() / 1'000'000), 4);
    put(out, static_cast<std::uint32_t>(us.count() % 1'000'000), 4);
    const auto size = static_cast<std::uint32_t>(kHeader + bytes.size());
    put(out, size, 4);
    put(out, size, 4);
    put(out, 0, 2);
    put(out, kHeader, 2);
    put(out, kFlags, 4);
    put(out, kFcsAtEnd, 1);
    out.write(reinterpret_cast<const char*>(bytes.data()),
              static_cast<std::streamsize>(bytes.size()));
  }
}

std::string address(hal::AgentId agent) {
  if (agent == hal::kEveryone) return "ff:ff:ff:ff:ff:ff";
  return fmt::format("02:00:00:00:{:02x}:{:02x}", agent.value >> 8, agent.value & 0xff);
}

/// What tshark prints of a frame if it is right: the fields that read() names.
std::string expected(const Frame& frame) {
  constexpr int kSubtypes[] = {0x20, 0x1b, 0x1c, 0x1d, 0x08, 0x0b, 0x0c, 0x00,
                               0x01, 0x02, 0x03, 0x0a, 0x18, 0x19, 0x0d};
  const auto us = std::chrono::ceil<std::chrono::microseconds>(frame.duration).count();
  std::string line =
      fmt::format("0x{:04x} good={} malformed= retry={:d} ds=0x{:02x} duration={} ra={}",
                  frame.qos ? 0x28 : kSubtypes[static_cast<int>(frame.type)], 1, frame.retry,
                  static_cast<int>(frame.ds), us, address(frame.receiver));
  if (is_control(frame.type)) return line + " seq= bssid= sa= da= ssid= interval=";
  const hal::AgentId bssid = frame.ds == Ds::kTo     ? frame.receiver
                             : frame.ds == Ds::kFrom ? frame.transmitter
                                                     : frame.address3;
  const bool names = frame.type == FrameType::kBeacon ||
                     frame.type == FrameType::kAssociationRequest ||
                     frame.type == FrameType::kReassociationRequest;
  return line + fmt::format(" seq={} bssid={} sa={} da={} ssid={} interval={}", frame.sequence,
                            address(bssid), address(frame.source()), address(frame.destination()),
                            names ? "626172616b61" : "",  // "baraka"
                            frame.type == FrameType::kBeacon ? "100" : "");
}

/// What another program makes of our bytes.
class Tshark : public testing::TestWithParam<Profile> {
 protected:
  void SetUp() override {
    if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  }
  ~Tshark() override { fs::remove(file_); }

  /// A frame.
  struct Dissected {
    std::string text;      ///< What expected() says.
    std::string elements;  ///< The numbers of its elements; those of extended ones after a tab.
    std::string edca;      ///< ACI, AIFSN, CWmin, CWmax and TXOP limit in 32 us.
  };

  /// All at once, for tshark takes a third of a second to start.
  std::vector<Dissected> read() const {
    const std::vector<std::pair<std::string, std::string>> fields{
        {"", "wlan.fc.type_subtype"},
        {"good=", "wlan.fcs.status"},
        {"malformed=", "_ws.malformed"},
        {"retry=", "wlan.fc.retry"},
        {"ds=", "wlan.fc.ds"},
        {"duration=", "wlan.duration"},
        {"ra=", "wlan.ra"},
        {"seq=", "wlan.seq"},
        {"bssid=", "wlan.bssid"},
        {"sa=", "wlan.sa"},
        {"da=", "wlan.da"},
        {"ssid=", "wlan.ssid"},
        {"interval=", "wlan.fixed.beacon"}};
    std::string command =
        "tshark -o wlan.check_checksum:TRUE -T fields -r '" + file_.string() + "'";
    for (const auto& [label, field] : fields) command += " -e " + field;
    command += " -e wlan.tag.number -e wlan.ext_tag.number";
    for (const char* const field : {"aci", "aifsn", "cw.min", "cw.max", "txop_limit"}) {
      command += std::string(" -e wlan.wfa.ie.wme.acp.") + field;
    }
    std::istringstream lines(tests::output_of(command + " 2>/dev/null"));
    std::vector<Dissected> all;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream values(line);
      Dissected& one = all.emplace_back();
      for (const auto& [label, field] : fields) {
        one.text += (one.text.empty() ? "" : " ") + label + next(values);
      }
      one.elements = next(values);
      one.elements += '\t' + next(values);
      std::getline(values, one.edca);
    }
    return all;
  }

  /// The first frame of a subtype: beacons are 8, association responses 1.
  static Dissected first(const std::vector<Dissected>& frames, int subtype) {
    const std::string begin = fmt::format("0x{:04x}", subtype);
    const auto found = std::ranges::find_if(
        frames, [&begin](const Dissected& frame) { return frame.text.starts_with(begin); });
    return found == frames.end() ? Dissected{} : *found;
  }

  static std::string next(std::istringstream& values) {
    std::string value;
    std::getline(values, value, '\t');
    return value;
  }

  const fs::path file_ = fs::path(testing::TempDir()) / fmt::format("bss_{}.pcap", ::getpid());
};

// A station walks to and fro between two access points, one of which forgets its stations.
TEST_P(Tshark, ReadsEveryFrameOfTwoAccessPointsAsItIsMeant) {
  Air air(GetParam());
  waves_of(air.config)->propagation.path_loss_exponent = 3;
  dcf_of(air.config)->bss.access_points = {"s1", "s2"};
  dcf_of(air.config)->contention.rts_threshold = 500;
  air.add({0, 0, 0});
  air.add({50, 0, 0});
  air.add({5, 0, 0}, {10, 0, 0});
  air.add({5, 5, 0});
  air.build();
  air.at(1s, [&air] { air.sap(1).set_radio(false); });
  air.at(1001ms, [&air] { air.sap(1).set_radio(true); });
  for (int i = 0; i < 300; ++i) {
    air.at(i * 10ms, [&air, i] { air.send(4, 3, i % 2 == 0 ? 50 : 1000); });
    air.at(i * 10ms + 3ms, [&air] { air.broadcast(3, 20); });
  }
  air.run(4s);
  write_pcap(file_, air.log.starts);
  const std::vector<Dissected> frames = read();
  ASSERT_EQ(frames.size(), air.log.starts.size());
  std::set<FrameType> seen;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Frame& frame = air.log.starts[i].frame;
    ASSERT_EQ(frames[i].text, expected(frame)) << "frame " << i + 1;
    seen.insert(frame.type);
  }
  // All but disassociation; stations with QoS agree on Block Ack, too, and have A-MPDUs.
  EXPECT_GE(seen.size(), dcf_of(air.config)->qos ? 13U : 11U);
  const std::map<Profile, std::string> elements{
      {Profile::kIeee80211b, "0,1,3,5\t"},
      {Profile::kIeee80211g, "0,1,3,5,42,50\t"},
      {Profile::kIeee80211n, "0,1,3,5,42,50,12,45,61\t"},
      {Profile::kIeee80211ac, "0,1,5,12,45,191,61,192\t"},
      {Profile::kIeee80211ax, "0,1,5,12,45,191,255,61,192,255\t35,36"}};
  EXPECT_EQ(first(frames, 8).elements, elements.at(GetParam()));
  // IEEE Std 802.11-2020, table 9-155: video 4.096 ms, voice 2.080 ms.
  const std::string edca = dcf_of(air.config)->qos
                               ? "0,1,2,3\t3,7,2,2\t15,15,7,3\t1023,1023,15,7\t0,0,128,65"
                               : "\t\t\t\t";
  for (const int subtype : {8, 1}) EXPECT_EQ(first(frames, subtype).edca, edca) << subtype;
}

/// What tshark reads of the HT Operation element in the last beacon of an access point of 40 MHz
/// beside two others.
std::string protection_with(const StationConfig& second, const StationConfig& third) {
  Air air(Profile::kIeee80211n);
  std::get<Ieee80211nConfig>(air.config).mcs.width = 40;
  dcf_of(air.config)->bss.access_points = {"s1"};
  for (int i = 0; i < 3; ++i) air.add({5.0 * i, 0, 0});
  air.station_config(2) = second;
  air.station_config(3) = third;
  air.build();
  air.run(510ms);
  const fs::path file = fs::path(testing::TempDir()) / fmt::format("ht_{}.pcap", ::getpid());
  write_pcap(file, air.log.starts);
  const std::string found = tests::output_of(
      "tshark -r '" + file.string() + "' -Y wlan.fc.type_subtype==8 -T fields" +
      " -e wlan.ht.info.secchanoffset -e wlan.ht.info.ht_protection -e wlan.ht.info.greenfield" +
      " -e wlan.ht.info.obssnonht -e _ws.malformed 2>/dev/null | tail -n 1");
  fs::remove(file);
  return found.substr(0, found.find('\n'));
}

// The secondary channel above; HT Protection, and whether there are members that do not know the
// greenfield format, and others that do not know HT.
TEST(TsharkHtOperation, ReadsTheProtectionThatAnAccessPointAsksFor) {
  if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "tshark is not installed";
  const StationConfig older{.standard = Standard::kIeee80211g}, narrow{.width = 20};
  StationConfig foreign = older;
  foreign.access_points = std::vector<std::string>{};
  EXPECT_EQ(protection_with({}, {}), "0x01\t0x0000\t1\t0\t");
  EXPECT_EQ(protection_with({}, foreign), "0x01\t0x0001\t1\t1\t");
  EXPECT_EQ(protection_with({}, narrow), "0x01\t0x0002\t1\t0\t");
  EXPECT_EQ(protection_with({}, older), "0x01\t0x0003\t1\t0\t");
}

INSTANTIATE_TEST_SUITE_P(Profiles, Tshark,
                         testing::Values(Profile::kIeee80211b, Profile::kIeee80211g,
                                         Profile::kIeee80211n, Profile::kIeee80211ac,
                                         Profile::kIeee80211ax),
                         [](const auto& c) {
                           std::string name(profile_name(profile_defaults(c.param)));
                           name.front() = 'I';
                           return name;
                         });

}  // namespace
}  // namespace sim::radio::test
