#include "gateway/guard/socket_table.h"

#include <arpa/inet.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <istream>
#include <string>

namespace gateway::guard {
namespace {

constexpr std::size_t kLocal = 1, kUser = 7, kInode = 9;  // columns
constexpr std::size_t kColumns = 10;
constexpr std::size_t kWord = 8;  // hexadecimal digits of 32 bits

template <class Number>
std::optional<Number> number_of(std::string_view text, int base) {
  Number number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The first columns of a line; missing columns are empty.
std::array<std::string_view, kColumns> columns_of(std::string_view line) {
  constexpr std::string_view kBlank = " \t";
  std::array<std::string_view, kColumns> columns;
  for (std::string_view& column : columns) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlank), line.size()));
    column = line.substr(0, line.find_first_of(kBlank));
    line.remove_prefix(column.size());
  }
  return columns;
}

/// 32 bits of an address, which the file has in network byte order, read as a number of this
/// machine.
std::optional<std::uint32_t> word_of(std::string_view digits) {
  const auto word = number_of<std::uint32_t>(digits, 16);
  if (!word) return std::nullopt;
  return ntohl(*word);
}

/// Parses an address into `socket`. @return whether the socket can send to IPv4 addresses.
bool read_address(std::string_view digits, TableSocket& socket) {
  const bool is_v6 = digits.size() == 4 * kWord;
  if (!is_v6 && digits.size() != kWord) return false;
  std::array<std::uint32_t, 3> front{};
  for (std::size_t i = 0; is_v6 && i < front.size(); ++i) {
    const auto word = word_of(digits.substr(i * kWord, kWord));
    if (!word) return false;
    front.at(i) = *word;
  }
  const auto last = word_of(digits.substr(digits.size() - kWord));
  if (!last) return false;
  socket.address = *last;
  if (!is_v6) return true;
  constexpr std::uint32_t kMapped = 0xffff;  // ::ffff:127.0.0.1 (RFC 4291, 2.5.5.2)
  socket.may_be_of_ipv6 = front[2] == 0 && *last == 0;
  return front[0] == 0 && front[1] == 0 && (front[2] == kMapped || socket.may_be_of_ipv6);
}

/// Removes sockets that cannot be the sender because of the other sockets.
std::vector<TableSocket> that_may_send(std::vector<TableSocket> sockets) {
  // An IPv6 socket shares its port with an IPv4 socket only if it sends to IPv6 addresses alone.
  const bool has_ipv4 =
      !std::ranges::all_of(sockets, [](const auto& one) { return one.may_be_of_ipv6; });
  if (has_ipv4) std::erase_if(sockets, [](const auto& one) { return one.may_be_of_ipv6; });
  return sockets;
}

}  // namespace

std::optional<TableSocket> table_socket(std::string_view line) {
  const auto columns = columns_of(line);
  const std::string_view local = columns[kLocal];
  const std::size_t colon = local.find(':');
  if (colon == std::string_view::npos || local.size() != colon + 5) return std::nullopt;
  TableSocket socket;
  if (!read_address(local.substr(0, colon), socket)) return std::nullopt;
  const auto port = number_of<std::uint16_t>(local.substr(colon + 1), 16);
  const auto user = number_of<std::uint32_t>(columns[kUser], 10);
  const auto inode = number_of<std::uint64_t>(columns[kInode], 10);
  if (!port || !user || !inode) return std::nullopt;
  socket.port = *port;
  socket.user = *user;
  socket.inode = *inode;
  return socket;
}

std::vector<TableSocket> sockets_with(std::uint16_t port, std::istream& udp, std::istream& udp6) {
  const std::string needle = fmt::format(":{:04X} ", port);
  std::vector<TableSocket> found;
  for (std::istream* file : {&udp, &udp6}) {
    for (std::string line; std::getline(*file, line);) {
      if (line.find(needle) == std::string::npos) continue;  // most lines
      const auto socket = table_socket(line);
      if (socket && socket->port == port) found.push_back(*socket);
    }
  }
  return found;
}

/// Repeats the search, because the kernel does not read its tables at one instant: while other
/// sockets come and go, an existing one can be missed.
std::optional<std::vector<TableSocket>> sockets_behind(const UdpSender& sender) {
  constexpr int kLooks = 3;
  std::vector<TableSocket> found;
  for (int look = 0; look < kLooks && found.empty(); ++look) {
    std::ifstream udp("/proc/self/net/udp");
    std::ifstream udp6("/proc/self/net/udp6");  // if it does not exist, there is no IPv6
    if (!udp) return std::nullopt;
    found = that_may_send(sockets_with(sender.port, udp, udp6));
  }
  return found;
}

}  // namespace gateway::guard
