// Ad hoc stations on a circle in real time, each with a TAP in a network namespace of its own:
// ordinary programs talk over ns-3's radio. Prints "ready" when the TAPs are there, and at the end
// how late it was and what it cost.
//
// Debian ships ns-3's TapBridge without the program tap-creator that it starts, and FdNetDevice
// cannot be bridged to an ad hoc station. So this program opens the TAPs and joins each to its
// WifiNetDevice as TapBridge's mode UseLocal does: a reader thread per TAP that schedules what it
// reads, the station has the TAP's address, and what the station receives is written to the TAP.
//
//   tap --namespaces=/proc/71/ns/net,/proc/72/ns/net --seconds=20
// Needs CAP_SYS_ADMIN in the user namespace that owns them.
#include <fcntl.h>
#include <linux/if_tun.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <iostream>
#include <sstream>

#include "ns3/fd-reader.h"
#include "ns3/realtime-simulator-impl.h"
#include "wifi.h"

using namespace ns3;

namespace {

constexpr int kHeader = 14;  // bytes of Ethernet
constexpr int kMostBytes = 65536;

void check(bool fine, const std::string& what) {
  if (fine) return;
  std::cerr << "tap: " << what << ": " << std::strerror(errno) << std::endl;
  std::exit(1);
}

/// wlan0 in a namespace, with address 02:00:00:00:hh:ll.
int open_tap(const std::string& space, unsigned number) {
  const int own = open("/proc/self/ns/net", O_RDONLY | O_CLOEXEC);
  const int other = open(space.c_str(), O_RDONLY | O_CLOEXEC);
  check(own >= 0 && other >= 0 && setns(other, CLONE_NEWNET) == 0, space);
  const int tap = open("/dev/net/tun", O_RDWR | O_CLOEXEC);
  check(tap >= 0, "/dev/net/tun");
  ifreq request{};
  std::strcpy(request.ifr_name, "wlan0");
  request.ifr_flags = IFF_TAP | IFF_NO_PI;
  check(ioctl(tap, TUNSETIFF, &request) == 0, "TUNSETIFF");
  request = {};
  request.ifr_hwaddr.sa_family = ARPHRD_ETHER;
  const unsigned char address[] = {
      2, 0, 0, 0, static_cast<unsigned char>(number >> 8), static_cast<unsigned char>(number)};
  std::memcpy(request.ifr_hwaddr.sa_data, address, sizeof address);
  check(ioctl(tap, SIOCSIFHWADDR, &request) == 0, "SIOCSIFHWADDR");
  check(setns(own, CLONE_NEWNET) == 0, "back to the own namespace");
  close(own);
  close(other);
  return tap;
}

Mac48Address address_of(unsigned number) {
  const uint8_t bytes[] = {
      2, 0, 0, 0, static_cast<uint8_t>(number >> 8), static_cast<uint8_t>(number)};
  Mac48Address address;
  address.CopyFrom(bytes);
  return address;
}

struct Counts {
  std::uint64_t from_taps = 0, to_taps = 0, refused = 0;
};
Counts counts;

class TapReader : public FdReader {
  FdReader::Data DoRead() override {
    auto* buffer = static_cast<uint8_t*>(std::malloc(kMostBytes));
    const ssize_t length = read(m_fd, buffer, kMostBytes);
    if (length > 0) return FdReader::Data(buffer, length);
    std::free(buffer);
    return FdReader::Data(nullptr, 0);
  }
};

class Tap {
 public:
  Tap(Ptr<WifiNetDevice> device, int descriptor)
      : device_(device), node_(device->GetNode()->GetId()), descriptor_(descriptor) {
    device_->SetPromiscReceiveCallback(MakeCallback(&Tap::on_received, this));
  }

  void start() {
    reader_ = Create<TapReader>();
    reader_->Start(descriptor_, MakeCallback(&Tap::on_read, this));
  }

  void stop() { reader_->Stop(); }

 private:
  /// In the reader's thread, which must not count references to what ns-3's thread uses.
  void on_read(uint8_t* frame, ssize_t length) {
    Simulator::ScheduleWithContext(node_, Time(0), MakeEvent(&Tap::send, this, frame, length));
  }

  void send(uint8_t* frame, ssize_t length) {
    ++counts.from_taps;
    if (length >= kHeader) {
      Mac48Address to;
      to.CopyFrom(frame);
      const uint16_t type = static_cast<uint16_t>(frame[12] << 8 | frame[13]);
      if (!device_->Send(Create<Packet>(frame + kHeader, length - kHeader), to, type))
        ++counts.refused;
    }
    std::free(frame);
  }

  bool on_received(Ptr<NetDevice>, Ptr<const Packet> packet, uint16_t type, const Address& from,
                   const Address& to, NetDevice::PacketType kind) {
    if (kind == NetDevice::PACKET_OTHERHOST) return true;
    std::vector<uint8_t> frame(kHeader + packet->GetSize());
    Mac48Address::ConvertFrom(to).CopyTo(frame.data());
    Mac48Address::ConvertFrom(from).CopyTo(frame.data() + 6);
    frame[12] = static_cast<uint8_t>(type >> 8);
    frame[13] = static_cast<uint8_t>(type);
    packet->CopyData(frame.data() + kHeader, packet->GetSize());
    counts.to_taps += write(descriptor_, frame.data(), frame.size()) > 0;
    return true;
  }

  Ptr<WifiNetDevice> device_;
  uint32_t node_;
  int descriptor_;
  Ptr<TapReader> reader_;
};

/// How late events are that are due every 10 ms, ms of wall time: later than the earliest of them.
class Lateness {
 public:
  void measure() {
    const auto now = std::chrono::steady_clock::now();
    if (late_.empty()) origin_ = now - std::chrono::nanoseconds(Simulator::Now().GetNanoSeconds());
    late_.push_back(std::chrono::duration<double, std::milli>(now - origin_).count() -
                    Simulator::Now().GetSeconds() * 1e3);
    Simulator::Schedule(MilliSeconds(10), &Lateness::measure, this);
  }

  double quantile(double share) {
    std::sort(late_.begin(), late_.end());
    return late_[static_cast<std::size_t>(share * static_cast<double>(late_.size() - 1))] -
           late_.front();
  }

 private:
  std::chrono::steady_clock::time_point origin_;
  std::vector<double> late_;
};

std::vector<Vector> circle(std::size_t count, double radius) {
  std::vector<Vector> places;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 2 * M_PI * static_cast<double>(i) / static_cast<double>(count);
    places.emplace_back(radius * std::cos(turn), radius * std::sin(turn), 1.5);
  }
  return places;
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

}  // namespace

int main(int argc, char** argv) {
  peer::Radio radio;
  std::string namespaces;
  double seconds = 20, radius = 5;
  CommandLine line;
  radio.add_to(line);
  line.AddValue("namespaces", "files of network namespaces, with commas between", namespaces);
  line.AddValue("seconds", "after which it ends", seconds);
  line.AddValue("radius", "of the circle, m", radius);
  line.Parse(argc, argv);

  std::vector<int> descriptors;
  std::istringstream names(namespaces);
  for (std::string name; std::getline(names, name, ',');)
    descriptors.push_back(open_tap(name, static_cast<unsigned>(descriptors.size())));
  check(!descriptors.empty(), "--namespaces: none given");

  GlobalValue::Bind("SimulatorImplementationType", StringValue("ns3::RealtimeSimulatorImpl"));
  GlobalValue::Bind("ChecksumEnabled", BooleanValue(true));
  const NetDeviceContainer devices =
      peer::stations(radio, circle(descriptors.size(), radius), peer::log_distance());
  std::vector<std::unique_ptr<Tap>> taps;
  for (std::size_t i = 0; i < descriptors.size(); ++i) {
    const auto device = DynamicCast<WifiNetDevice>(devices.Get(static_cast<uint32_t>(i)));
    device->SetAddress(address_of(static_cast<unsigned>(i)));
    taps.push_back(std::make_unique<Tap>(device, descriptors[i]));
  }
  Lateness lateness;
  Simulator::Schedule(Seconds(0), [&taps] {
    for (const auto& tap : taps) tap->start();
    std::cout << "ready" << std::endl;
  });
  Simulator::Schedule(MilliSeconds(10), &Lateness::measure, &lateness);
  Simulator::Stop(Seconds(seconds));
  Simulator::Run();
  for (const auto& tap : taps) tap->stop();
  std::cout << "from_taps: " << counts.from_taps << "\nto_taps: " << counts.to_taps
            << "\nrefused: " << counts.refused << "\nlate_ms_median: " << lateness.quantile(0.5)
            << "\nlate_ms_99: " << lateness.quantile(0.99)
            << "\nlate_ms_max: " << lateness.quantile(1) << "\ncpu_s: " << cpu_seconds()
            << std::endl;
  Simulator::Destroy();
}
