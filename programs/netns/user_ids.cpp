#include "programs/netns/user_ids.h"

#include <fmt/format.h>
#include <poll.h>
#include <pwd.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <vector>

#include "programs/netns/launch.h"

namespace programs::netns {
namespace {

/// Bits in the first octet of the child's answer: the maps that it has written. A message why not
/// all follows.
constexpr char kUsers = 1, kGroups = 2;

/// A range from a line of /etc/subuid: subuid(5).
struct SubordinateIds {
  std::uint32_t first = 0, count = 0;
};

std::optional<std::uint32_t> number_in(std::string_view text) {
  std::uint32_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || last != end) return std::nullopt;
  return value;
}

/// The first range of this user, given by name or number.
std::optional<SubordinateIds> subordinate_ids(const char* file) {
  const std::string number = std::to_string(geteuid());
  const passwd* const entry = getpwuid(geteuid());
  const std::string name = entry == nullptr ? number : entry->pw_name;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream fields(line);
    std::string user, first, count;
    std::getline(fields, user, ':');
    std::getline(fields, first, ':');
    std::getline(fields, count);
    const auto begin = number_in(first), length = number_in(count);
    if ((user != name && user != number) || !begin || !length || *length == 0) continue;
    return SubordinateIds{*begin, *length};
  }
  return std::nullopt;
}

/// Calls newuidmap or newgidmap of the package uidmap. @return why it failed; empty: it succeeded.
std::string ask_for_map(const char* program, pid_t process, std::uint32_t own,
                        const SubordinateIds& more) {
  const std::vector<std::string> words{program,
                                       std::to_string(process),
                                       "0",
                                       std::to_string(own),
                                       "1",
                                       "1",
                                       std::to_string(more.first),
                                       std::to_string(more.count)};
  posix_spawn_file_actions_t quiet{};
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = -1;
  const int error =
      posix_spawnp(&child, program, &quiet, nullptr, pointers_to(words).data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
  if (error != 0) return fmt::format("{} is missing; it is in the package uidmap", program);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
  return status == 0 ? "" : fmt::format("{} refuses what its file has for this user", program);
}

std::string map_as_root(pid_t process, char& done) {
  try {
    const std::string users = identity_map("/proc/self/uid_map");
    write_file(fmt::format("/proc/{}/uid_map", process), users);
    done |= kUsers;
    write_file(fmt::format("/proc/{}/gid_map", process), identity_map("/proc/self/gid_map"));
    done |= kGroups;
    return users == "0 0 1\n" ? "there is no other where it was started, in a user namespace" : "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::string map_as_user(pid_t process, char& done) {
  const auto users = subordinate_ids("/etc/subuid"), groups = subordinate_ids("/etc/subgid");
  if (!users || !groups) {
    return fmt::format(
        "{} has no line of this user; 'usermod --add-subuids 100000-165535 --add-subgids "
        "100000-165535 NAME' makes them",
        users ? "/etc/subgid" : "/etc/subuid");
  }
  std::string why = ask_for_map("newuidmap", process, geteuid(), *users);
  if (!why.empty()) return why;
  done |= kUsers;
  why = ask_for_map("newgidmap", process, getegid(), *groups);
  if (why.empty()) done |= kGroups;
  return why;
}

/// Runs in the child: waits for the request, and ends if the parent has ended.
[[noreturn]] void map_from_outside(int socket, pid_t process) {
  char asked = 0;
  if (read(socket, &asked, 1) != 1) _exit(0);
  char done = 0;
  std::string why = geteuid() == 0 ? map_as_root(process, done) : map_as_user(process, done);
  why.insert(why.begin(), done);
  [[maybe_unused]] const ssize_t written = write(socket, why.data(), why.size());
  _exit(0);
}

struct Extent {
  std::uint32_t first = 0, outside = 0, count = 0;
};

std::vector<Extent> extents_of(const char* file) {
  std::vector<Extent> all;
  std::ifstream in(file);
  for (Extent one; in >> one.first >> one.outside >> one.count;) all.push_back(one);
  if (all.empty()) fail(file, EINVAL);
  return all;
}

}  // namespace

IdMapper::IdMapper() : user_(geteuid()), group_(getegid()) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) fail("a socket");
  socket_.reset(ends[0]);
  const FileDescriptor theirs(ends[1]);
  const pid_t process = getpid();
  child_ = fork();
  if (child_ < 0) fail("the process that maps users");
  if (child_ > 0) return;
  socket_.reset();
  map_from_outside(theirs.get(), process);
}

IdMapper::~IdMapper() {
  socket_.reset();
  while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) continue;
}

std::string IdMapper::map() {
  std::array<char, 1024> answer{};
  ssize_t length = send(socket_.get(), "m", 1, MSG_NOSIGNAL);
  if (length > 0) length = read(socket_.get(), answer.data(), answer.size());
  const char done = length > 0 ? answer[0] : '\0';
  if ((done & kUsers) == 0) write_file("/proc/self/uid_map", fmt::format("0 {} 1", user_));
  if ((done & kGroups) == 0) {
    write_file("/proc/self/setgroups", "deny");
    write_file("/proc/self/gid_map", fmt::format("0 {} 1", group_));
  }
  if (length <= 0) return "the process that maps users has ended";
  return {answer.data() + 1, static_cast<std::size_t>(length - 1)};
}

std::string identity_map(const char* file) {
  std::string map;
  for (const Extent& one : extents_of(file)) {
    map += fmt::format("{} {} {}\n", one.first, one.first, one.count);
  }
  return map;
}

gid_t last_group() {
  std::vector<Extent> extents = extents_of("/proc/self/gid_map");
  std::ranges::sort(extents, {}, &Extent::first);
  std::uint64_t end = 0;
  for (const Extent& one : extents) {
    if (one.first == end) end += one.count;
  }
  return static_cast<gid_t>(std::max<std::uint64_t>(end, 1) - 1);
}

void write_file(const std::string& path, const std::string& content, int flags) {
  const FileDescriptor file = open_file(path, O_WRONLY | flags, 0644);
  if (write(file.get(), content.data(), content.size()) < 0) fail(path);
}

}  // namespace programs::netns
