#include "programs/netns/tcp_timers.h"

#include <unistd.h>

#include <array>
#include <sstream>
#include <string>

namespace programs::netns {
namespace {

std::string table_in(int file) {
  std::string content;
  std::array<char, 4096> part{};
  for (;;) {
    const ssize_t length =
        pread(file, part.data(), part.size(), static_cast<off_t>(content.size()));
    if (length <= 0) return content;
    content.append(part.data(), static_cast<std::size_t>(length));
  }
}

/// A line: "0: address:port address:port state sent:received timer:when …", all in hexadecimal.
bool waits(const std::string& line) {
  constexpr int kBefore = 5;
  constexpr const char *kRetransmission = "01:", *kWindowProbe = "04:";
  std::istringstream words(line);
  std::string word;
  for (int i = 0; i <= kBefore; ++i) words >> word;
  return word.starts_with(kRetransmission) || word.starts_with(kWindowProbe);
}

}  // namespace

bool has_tcp_timer(int table) {
  if (table < 0) return false;
  std::istringstream lines(table_in(table));
  for (std::string line; std::getline(lines, line);) {
    if (waits(line)) return true;
  }
  return false;
}

}  // namespace programs::netns
