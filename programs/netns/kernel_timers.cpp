#include "programs/netns/kernel_timers.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "programs/netns/descriptor.h"
#include "programs/netns/interface.h"

namespace programs::netns {
namespace {

constexpr std::array kOfNeighbours{
    "retrans_time_ms", "base_reachable_time_ms", "delay_first_probe_time", "gc_stale_time",
    "locktime",        "interval_probe_time_ms"};

void stretch(const std::string& path, double factor) {
  const FileDescriptor file(open(path.c_str(), O_RDWR | O_CLOEXEC));
  if (!file.is_open() && errno == ENOENT) return;  // this kernel does not have this timer
  if (!file.is_open()) fail(path);
  std::array<char, 32> text{};
  const ssize_t length = read(file.get(), text.data(), text.size());
  std::int64_t value = 0;
  if (length <= 0 || std::from_chars(text.data(), text.data() + length, value).ec != std::errc{}) {
    fail(path, EINVAL);
  }
  const double most = std::numeric_limits<std::int32_t>::max();
  const double stretched = std::min(std::round(static_cast<double>(value) / factor), most);
  const std::string written = std::to_string(static_cast<std::int64_t>(stretched));
  if (pwrite(file.get(), written.data(), written.size(), 0) < 0) fail(path);
}

}  // namespace

void stretch_kernel_timers(double factor) {
  if (factor == 1) return;
  const std::string net = "/proc/sys/net/";
  for (const char* family : {"ipv4", "ipv6"}) {
    for (const char* timer : kOfNeighbours) {
      stretch(net + family + "/neigh/" + kInterface + "/" + timer, factor);
    }
  }
  stretch(net + "ipv4/ipfrag_time", factor);
  stretch(net + "ipv6/ip6frag_time", factor);
  const std::string ipv4 = net + "ipv4/conf/" + kInterface + "/";
  for (const char* report : {"igmpv2", "igmpv3"}) {
    stretch(ipv4 + report + "_unsolicited_report_interval", factor);
  }
  const std::string ipv6 = net + "ipv6/conf/" + kInterface + "/";
  for (const char* report : {"mldv1", "mldv2"}) {
    stretch(ipv6 + report + "_unsolicited_report_interval", factor);
  }
}

void hold_kernel_timers() {
  constexpr double kSlowest = 1e-4;  // a second becomes three hours
  stretch_kernel_timers(kSlowest);
  const std::string ipv6 = "/proc/sys/net/ipv6/";
  for (const std::string& file :
       {ipv6 + "conf/" + kInterface + "/router_solicitations", ipv6 + "auto_flowlabels"}) {
    const FileDescriptor opened(open(file.c_str(), O_WRONLY | O_CLOEXEC));
    if (!opened.is_open() && errno == ENOENT) continue;  // a kernel without IPv6
    if (!opened.is_open() || pwrite(opened.get(), "0", 1, 0) != 1) fail(file);
  }
}

}  // namespace programs::netns
