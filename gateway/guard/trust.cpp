#include "gateway/guard/trust.h"

#include <fmt/core.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "gateway/guard/socket_table.h"

namespace gateway::guard {
namespace {

constexpr const char* kUnverified = "unverified";

/// The id of a user who is given by id or by name.
uid_t user_called(const std::string& word) {
  if (word.find_first_not_of("0123456789") == std::string::npos) {
    std::istringstream digits(word);
    std::uint64_t number = 0;
    // The highest 32-bit number stands for no user.
    if (digits >> number && number < std::numeric_limits<uid_t>::max()) {
      return static_cast<uid_t>(number);
    }
  }
  passwd entry{};
  passwd* found = nullptr;
  std::array<char, 16384> texts{};
  if (getpwnam_r(word.c_str(), &entry, texts.data(), texts.size(), &found) == 0 && found) {
    return found->pw_uid;
  }
  throw NoSuchUser(fmt::format("{}: '{}' is not a user of this computer, nor '{}'", kTrustVariable,
                               word, kUnverified));
}

std::string content_of(const char* file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

SenderJudgement unverified(const UdpSender& sender, const Trust& trust, const char* why) {
  if (trust.covers_unverified()) return {};
  return {{}, 0, fmt::format("{} {}", why, sender.text())};
}

}  // namespace

Trust::Trust(std::string_view text) {
  std::string blanks(text);
  std::ranges::replace(blanks, ',', ' ');
  std::istringstream words(blanks);
  for (std::string word; words >> word;) {
    if (word == kUnverified) {
      covers_unverified_ = true;
    } else {
      users_.push_back(user_called(word));
    }
  }
}

Trust Trust::of_environment() {
  const char* text = std::getenv(kTrustVariable);
  return text == nullptr ? Trust() : Trust(text);
}

bool Trust::covers(uid_t user) const {
  return user == 0 || user == geteuid() || std::ranges::find(users_, user) != users_.end();
}

bool is_told(uid_t user, uid_t overflow, std::string_view map) {
  if (user != overflow) return true;
  // The map of the initial user namespace, which contains all users.
  std::istringstream line{std::string(map)};
  std::uint64_t inside = 1, outside = 1, length = 0;
  line >> inside >> outside >> length;
  return inside == 0 && outside == 0 && length == std::numeric_limits<std::uint32_t>::max();
}

bool is_told(uid_t user) {
  constexpr uid_t kUsual = 65534;
  std::istringstream overflow(content_of("/proc/sys/kernel/overflowuid"));
  uid_t number = 0;
  if (!(overflow >> number)) number = kUsual;
  return is_told(user, number, content_of("/proc/self/uid_map"));
}

SenderJudgement judge_sender(const UdpSender& sender, const Trust& trust) {
  const auto sockets = sockets_behind(sender);
  if (!sockets)
    return unverified(sender, trust, "/proc/net/udp cannot be read, which tells who has");
  if (sockets->empty()) return unverified(sender, trust, "nobody has any more");
  for (const TableSocket& one : *sockets) {
    if (!is_told(one.user)) {
      return unverified(sender, trust, "a user without a number here (see BARAKA_TRUST) has");
    }
    if (trust.covers(one.user)) continue;
    return {one.user, one.inode, fmt::format("user {} has {}", one.user, sender.text())};
  }
  return {sockets->front().user, sockets->front().inode, {}};
}

}  // namespace gateway::guard
