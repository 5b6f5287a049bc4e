#include "hal/files/recording/capture.h"

#include <fmt/format.h>

#include <stdexcept>

#include "hal/files/recording/capture_file.h"
#include "hal/files/recording/file_fault.h"
#include "hal/files/recording/link_layer.h"
#include "hal/files/recording/reassembly.h"
#include "hal/files/recording/rtps_traffic.h"

namespace hal::files::recording {
namespace {

class CaptureReader {
 public:
  CaptureReader(const MappedFile& file, Collector& into) : file_(file), into_(into) {}

  void read();

 private:
  void read_packet(const CapturedPacket& packet);
  void read_network(std::int64_t at, const NetworkPacket& packet, bool is_cut);
  void read_datagram(const WholeDatagram& datagram);
  void say(std::size_t count, std::string_view what) {
    if (count > 0) into_.note(fmt::format("{} {}", count, what));
  }

  const MappedFile& file_;
  Collector& into_;
  LinkLayer link_;
  Reassembly reassembly_;
  RtpsTraffic rtps_;
  std::size_t packets_ = 0, cut_ = 0;
};

void CaptureReader::read() {
  const std::size_t timeless =
      read_packets(file_.octets(), [this](const CapturedPacket& packet) { read_packet(packet); });
  rtps_.finish(into_);
  say(timeless, "packets have no time stamp and are left out");
  say(cut_, "packets were cut by the snap length of the capture and are left out");
  say(reassembly_.unfinished(), "IP datagrams lack fragments and are left out");
  say(link_.wireless().encrypted(), "frames are encrypted; what they carry is not seen");
  say(link_.wireless().fragments(), "frames are fragments of MSDUs and are left out");
}

void CaptureReader::read_packet(const CapturedPacket& packet) {
  ++packets_;
  const auto begin = static_cast<std::uint64_t>(packet.octets.data() - file_.octets().data());
  try {
    link_.read(packet, [&](const NetworkPacket& network) {
      read_network(packet.at, network, packet.is_cut);
    });
  } catch (const FileFault& fault) {
    throw FileFault{begin, fmt::format("packet {}: {}", packets_, fault.what)};
  } catch (const std::runtime_error& e) {
    throw FileFault{begin, fmt::format("packet {}: {}", packets_, e.what())};
  }
}

void CaptureReader::read_network(std::int64_t at, const NetworkPacket& packet, bool is_cut) {
  const bool is_ip =
      packet.ethertype == rtps::kEthertypeIpv4 || packet.ethertype == rtps::kEthertypeIpv6;
  if (!is_ip) return;
  const auto ip = rtps::read_ip(packet.ethertype, packet.packet);
  if (!ip) {
    cut_ += is_cut ? 1 : 0;
    return;
  }
  if (ip->key.protocol != rtps::protocol::kUdp) return;
  if (const auto whole = reassembly_.add(at, *ip)) read_datagram(*whole);
}

void CaptureReader::read_datagram(const WholeDatagram& datagram) {
  rtps::Cursor cursor(datagram.payload, rtps::Endianness::kBig);
  cursor.take(2);  // source port
  const std::uint16_t port = cursor.u16(), length = cursor.u16();
  cursor.take(2);  // checksum: may be left to offloading
  constexpr std::size_t kHeader = 8;
  if (cursor.is_short() || length < kHeader || length > datagram.payload.size()) return;
  const Octets payload = datagram.payload.subspan(kHeader, length - kHeader);
  if (rtps_.read(datagram.at, datagram.source, payload)) return;
  into_.add_datagram(port, datagram.at, static_cast<std::uint32_t>(payload.size()));
}

}  // namespace

void read_capture(const MappedFile& file, Collector& into) {
  try {
    CaptureReader(file, into).read();
  } catch (const FileFault& fault) {
    throw std::runtime_error(fmt::format(
        "{}: byte {}: {}{}", file.name(), fault.at, fault.what,
        fault.is_cut ? "; `editcap` writes a file of the packets before it, which are whole" : ""));
  }
}

}  // namespace hal::files::recording
