// The modes of HT (mixed format), VHT and HE (single user): how long PSDUs last, and the packet
// error rate of the NIST model. --airtimes or --errors; CSV with a heading.
//   format,mcs,streams,width,guard_ns,band,bytes,ns      format,mcs,streams,bytes,snr_db,per
#include <cmath>
#include <iomanip>
#include <iostream>

#include "ns3/core-module.h"
#include "ns3/wifi-module.h"

using namespace ns3;

namespace {

struct Format {
  const char* name;
  int mcs;
  WifiPreamble preamble;
  std::vector<uint16_t> widths, guards;
};

const std::vector<Format> kFormats{
    {"ht", 7, WIFI_PREAMBLE_HT_MF, {20, 40}, {800, 400}},
    {"vht", 9, WIFI_PREAMBLE_VHT_SU, {20, 40, 80}, {800, 400}},
    {"he", 11, WIFI_PREAMBLE_HE_SU, {20, 40, 80}, {800, 1600, 3200}}};

WifiMode mode(const Format& format, int mcs, int streams) {
  const std::string name(format.name);
  if (name == "ht") return HtPhy::GetHtMcs(mcs + 8 * (streams - 1));
  return name == "vht" ? VhtPhy::GetVhtMcs(mcs) : HePhy::GetHeMcs(mcs);
}

WifiTxVector vector(const Format& format, int mcs, int streams, uint16_t width, uint16_t guard) {
  return WifiTxVector(mode(format, mcs, streams), 0, format.preamble, guard, streams, streams, 0,
                      width, false);
}

void airtimes(const Format& format, int mcs, int streams) {
  const bool is_vht = std::string(format.name) == "vht";
  for (const uint16_t width : format.widths) {
    for (const uint16_t guard : format.guards) {
      const auto sent = vector(format, mcs, streams, width, guard);
      if (!sent.IsValid()) continue;
      for (const bool is_5ghz : {false, true}) {
        if (is_vht && !is_5ghz) continue;
        const auto band = is_5ghz ? WIFI_PHY_BAND_5GHZ : WIFI_PHY_BAND_2_4GHZ;
        for (const uint32_t bytes : {100u, 1538u}) {
          std::cout << format.name << ',' << mcs << ',' << streams << ',' << width << ',' << guard
                    << ',' << (is_5ghz ? "5" : "2.4") << ',' << bytes << ','
                    << WifiPhy::CalculateTxDuration(bytes, sent, band).GetNanoSeconds() << '\n';
        }
      }
    }
  }
}

void errors(const Format& format, int mcs) {
  const auto sent = vector(format, mcs, 1, 20, 800);
  const auto model = CreateObject<NistErrorRateModel>();
  for (const int bytes : {100, 1500}) {
    for (double db = -2; db < 45; db += 0.25) {
      const double right =
          model->GetChunkSuccessRate(sent.GetMode(), sent, std::pow(10, db / 10), 8 * bytes);
      if (right > 0.9999 || right < 1e-6) continue;
      std::cout << format.name << ',' << mcs << ",1," << bytes << ',' << db << ','
                << std::setprecision(15) << 1 - right << std::setprecision(6) << '\n';
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  bool wants_errors = false;
  CommandLine line;
  line.AddValue("errors", "packet error rates rather than airtimes", wants_errors);
  line.Parse(argc, argv);
  std::cout << "# ns-3.37, "
            << (wants_errors ? "NistErrorRateModel: packet error rate of a PSDU at an SNR\n"
                             : "WifiPhy::CalculateTxDuration of a PSDU\n");
  std::cout << (wants_errors ? "format,mcs,streams,bytes,snr_db,per\n"
                             : "format,mcs,streams,width,guard_ns,band,bytes,ns\n");
  for (const Format& format : kFormats) {
    for (int mcs = 0; mcs <= format.mcs; ++mcs) {
      if (wants_errors) errors(format, mcs);
      for (int streams = 1; streams <= 4 && !wants_errors; ++streams)
        airtimes(format, mcs, streams);
    }
  }
}
