#include "results/record/radiotap_phy.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "results/record/pcapng.h"
#include "tests/support/output_of.h"
#include "tests/unit/results/record/test_run.h"

namespace results::record::test {
namespace {

struct Packet {
  RadiotapMode mode;
  std::optional<RadiotapAmpdu> ampdu{};
};

/// A header that ends after its flags, an odd number of bytes, and has the fields of the packet.
hal::Bytes header_of(const Packet& packet) {
  constexpr std::uint32_t kFlags = 1U << 1;
  hal::Bytes header{0, 0, 0, 0, 0, 0, 0, 0, /* flags */ 0};
  const std::uint32_t present = kFlags | put_radiotap_phy(header, packet.mode, packet.ampdu);
  header[2] = static_cast<std::uint8_t>(header.size());
  for (std::size_t i = 0; i < 4; ++i) header[4 + i] = static_cast<std::uint8_t>(present >> (8 * i));
  return header;
}

/// The value of QoS Null, without an FCS.
const hal::Bytes kQosNull{0xc8, 0x01, 0, 0, 2, 0, 0, 0, 0, 1, 2, 0, 0,
                          0,    0,    2, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0};

/// What tshark prints of the fields, a line for each packet.
std::vector<std::string> printed(const std::vector<Packet>& packets, const std::string& fields) {
  const Folder folder(testing::UnitTest::GetInstance()->current_test_info()->name());
  const std::filesystem::path file = folder.path() / "phy.pcapng";
  PcapngFile out(file, "air");
  for (const Packet& packet : packets) {
    hal::Bytes bytes = header_of(packet);
    bytes.insert(bytes.end(), kQosNull.begin(), kQosNull.end());
    out.add(hal::Time{}, PcapngFile::Direction::kUnknown, bytes);
  }
  out.flush();
  std::string command =
      fmt::format("tshark -r {} -T fields -E separator=/s -E occurrence=a", file.string());
  std::istringstream names(fields + " _ws.malformed");
  for (std::string name; names >> name;) command += " -e " + name;
  std::istringstream said(tests::output_of(command + " 2>/dev/null"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(said, line);) {
    line.erase(line.find_last_not_of(' ') + 1);
    lines.push_back(line);
  }
  return lines;
}

class RadiotapPhyInTshark : public testing::Test {
 protected:
  void SetUp() override {
    if (tests::output_of("command -v tshark").empty()) GTEST_SKIP() << "needs tshark";
  }
};

using Lines = std::vector<std::string>;

TEST(RadiotapPhy, FieldsAreAlignedAndInTheOrderOfTheirBits) {
  const RadiotapAmpdu ampdu{.reference = 0x01020304};
  const hal::Bytes ht = header_of({{.phy = RadiotapPhy::kHt}, ampdu});
  EXPECT_EQ(ht.size(), 9u + 3 + 8);  // MCS at 9, A-MPDU at 12
  EXPECT_EQ(ht[12], 0x04);
  const hal::Bytes vht = header_of({{.phy = RadiotapPhy::kVht}, ampdu});
  EXPECT_EQ(vht.size(), 12u + 8 + 12);  // A-MPDU at 12 after padding, VHT at 20
  EXPECT_EQ(vht[15], 0x01);
  const hal::Bytes he = header_of({{.phy = RadiotapPhy::kHe}, {}});
  EXPECT_EQ(he.size(), 10u + 12);  // HE at 10 after padding
}

TEST_F(RadiotapPhyInTshark, ReadsEveryMcsOfHt) {
  std::vector<Packet> packets;
  Lines expected;
  for (int index = 0; index < 32; ++index) {
    for (const bool is_wide : {false, true}) {
      const bool is_short = index % 3 == 0, is_ldpc = index % 2 == 0;
      packets.push_back({{.phy = RadiotapPhy::kHt,
                          .mcs = index % 8,
                          .streams = index / 8 + 1,
                          .width_mhz = is_wide ? 40 : 20,
                          .guard_ns = is_short ? 400 : 800,
                          .is_ldpc = is_ldpc}});
      expected.push_back(fmt::format("{} {:d} {:d} 0 {:d} 0", index, is_wide, is_short, is_ldpc));
    }
  }
  EXPECT_EQ(printed(packets,
                    "radiotap.mcs.index radiotap.mcs.bw radiotap.mcs.gi "
                    "radiotap.mcs.format radiotap.mcs.fec radiotap.mcs.stbc"),
            expected);
}

TEST_F(RadiotapPhyInTshark, ReadsEveryMcsOfVht) {
  std::vector<Packet> packets;
  Lines expected;
  const std::vector<std::pair<int, int>> widths{{20, 0}, {40, 1}, {80, 4}, {160, 11}};
  for (int mcs = 0; mcs < 10; ++mcs) {
    for (const auto& [width, code] : widths) {
      const int streams = 1 + (mcs + code) % 8;
      const bool is_short = mcs % 2 == 0, is_ldpc = mcs % 3 == 0;
      packets.push_back({{.phy = RadiotapPhy::kVht,
                          .mcs = mcs,
                          .streams = streams,
                          .width_mhz = width,
                          .guard_ns = is_short ? 400 : 800,
                          .is_ldpc = is_ldpc}});
      expected.push_back(
          fmt::format("{} {} {} {:d} {:d} 0", mcs, streams, code, is_short, is_ldpc));
    }
  }
  EXPECT_EQ(printed(packets,
                    "radiotap.vht.mcs.0 radiotap.vht.nss.0 radiotap.vht.bw "
                    "radiotap.vht.gi radiotap.vht.coding.0 radiotap.vht.stbc"),
            expected);
}

TEST_F(RadiotapPhyInTshark, ReadsEveryMcsOfHe) {
  std::vector<Packet> packets;
  Lines expected;
  const std::vector<std::pair<int, int>> widths{{20, 0}, {40, 1}, {80, 2}, {160, 3}};
  const std::vector<std::pair<int, int>> guards{{800, 0}, {1600, 1}, {3200, 2}};
  const std::vector<std::pair<std::optional<int>, int>> ltfs{
      {std::nullopt, 0}, {3200, 1}, {6400, 2}, {12800, 3}};
  for (int mcs = 0; mcs < 12; ++mcs) {
    for (std::size_t i = 0; i < widths.size(); ++i) {
      const auto& [guard, guard_code] = guards[(static_cast<std::size_t>(mcs) + i) % 3];
      const auto& [ltf, ltf_code] = ltfs[(static_cast<std::size_t>(mcs) + i) % 4];
      const int streams = 1 + mcs % 8;
      const bool is_ldpc = i > 0;
      packets.push_back({{.phy = RadiotapPhy::kHe,
                          .mcs = mcs,
                          .streams = streams,
                          .width_mhz = widths[i].first,
                          .guard_ns = guard,
                          .is_ldpc = is_ldpc,
                          .he_ltf_ns = ltf}});
      const std::string symbol = ltf ? fmt::format("0x{:04x}", ltf_code) : "";  // else unknown
      expected.push_back(fmt::format("0x0000 0x{:04x} 0x{:04x} 0x{:04x} 0x{:04x} {} 0x{:04x} 1",
                                     mcs, streams, widths[i].second, guard_code, symbol,
                                     is_ldpc ? 1 : 0));
    }
  }
  EXPECT_EQ(printed(packets,
                    "radiotap.he.data_1.ppdu_format radiotap.he.data_3.data_mcs "
                    "radiotap.he.data_6.nsts "
                    "radiotap.he.data_5.data_bw_ru_allocation radiotap.he.data_5.gi "
                    "radiotap.he.data_5.ltf_symbol_size radiotap.he.data_3.coding "
                    "radiotap.he.data_2.gi_known"),
            expected);
}

TEST_F(RadiotapPhyInTshark, ReadsThePlaceInTheAmpdu) {
  const RadiotapMode ht{.phy = RadiotapPhy::kHt, .mcs = 7};
  const RadiotapMode vht{.phy = RadiotapPhy::kVht, .mcs = 9, .width_mhz = 80};
  const std::vector<Packet> packets{
      {ht, RadiotapAmpdu{.reference = 7}},
      {ht, RadiotapAmpdu{.reference = 7, .is_last = true}},
      {vht, RadiotapAmpdu{.reference = 4'000'000'000, .is_last_known = false, .is_eof = false}},
      {vht, RadiotapAmpdu{.reference = 8, .is_last = true, .is_eof = true, .delimiter_crc = 0xab}}};
  EXPECT_EQ(printed(packets,
                    "radiotap.ampdu.reference radiotap.ampdu.flags.lastknown "
                    "radiotap.ampdu.flags.last radiotap.ampdu.flags.eof_known "
                    "radiotap.ampdu.flags.eof radiotap.ampdu.delim_crc"),
            (Lines{"7 1 0 0 0", "7 1 1 0 0", "4000000000 0 0 1 0", "8 1 1 1 1 0xab"}));
}

/// tshark computes the rates from what the fields say: those of IEEE Std 802.11-2020, 19.5
/// and 21.5, and of IEEE Std 802.11ax-2021, 27.5.
TEST_F(RadiotapPhyInTshark, ComputesTheRatesOfTheStandard) {
  const std::vector<Packet> packets{
      {{.phy = RadiotapPhy::kHt, .mcs = 7, .guard_ns = 400}},
      {{.phy = RadiotapPhy::kHt, .mcs = 7, .streams = 2, .width_mhz = 40, .guard_ns = 400}},
      {{.phy = RadiotapPhy::kVht, .mcs = 9, .streams = 2, .width_mhz = 80, .guard_ns = 400}},
      {{.phy = RadiotapPhy::kHe, .mcs = 11, .width_mhz = 80, .is_ldpc = true}}};
  EXPECT_EQ(printed(packets, "wlan_radio.data_rate"),
            (Lines{"72.2222", "300", "866.667", "600.5"}));
}

}  // namespace
}  // namespace results::record::test
