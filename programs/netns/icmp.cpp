#include "programs/netns/icmp.h"

#include <fcntl.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"

namespace programs::netns {
namespace {

void write_bound(const char* path, const std::string& value) {
  const FileDescriptor file(open(path, O_WRONLY | O_CLOEXEC));
  if (!file.is_open() && errno == ENOENT) return;
  if (!file.is_open() || write(file.get(), value.data(), value.size()) < 0) fail(path);
}

std::vector<std::string> fields_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// From two lines that begin with "Icmp:": names and values.
std::uint64_t errors_of_ipv4() {
  std::ifstream in("/proc/self/net/snmp");
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("Icmp:")) continue;
    const std::vector<std::string> fields = fields_of(line);
    const auto found = std::ranges::find(names, "OutErrors");
    const auto place = static_cast<std::size_t>(found - names.begin());
    if (place < std::min(names.size(), fields.size())) return std::stoull(fields[place]);
    names = fields;
  }
  return 0;
}

/// From lines with a name and a value.
std::uint64_t errors_of_ipv6() {
  std::ifstream in("/proc/self/net/snmp6");
  std::string name;
  for (std::uint64_t value = 0; in >> name >> value;) {
    if (name == "Icmp6OutErrors") return value;
  }
  return 0;
}

}  // namespace

void bound_icmp_errors(std::size_t agents) {
  constexpr std::size_t kFew = 4, kAtOnce = 100;
  constexpr std::size_t kSeconds = 4;  // a burst, and three seconds at the rate
  if (agents <= kFew) return;
  const std::string bound = std::to_string(std::max<std::size_t>(1, kAtOnce / kSeconds / agents));
  write_bound("/proc/sys/net/ipv4/icmp_msgs_per_sec", bound);
  write_bound("/proc/sys/net/ipv4/icmp_msgs_burst", bound);
}

void unbound_icmp_errors() {
  write_bound("/proc/sys/net/ipv4/icmp_ratemask", "0");
  write_bound("/proc/sys/net/ipv6/icmp/ratemask", "\n");
  write_bound("/proc/sys/net/ipv6/icmp/ratelimit", "0");
}

std::uint64_t icmp_not_sent() { return errors_of_ipv4() + errors_of_ipv6(); }

}  // namespace programs::netns
