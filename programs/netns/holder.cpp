#include "programs/netns/holder.h"

#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <array>
#include <csignal>
#include <vector>

#include "programs/netns/launch.h"

namespace programs::netns {
namespace {

constexpr int kControl = STDERR_FILENO + 1, kEvents = kControl + 1;

struct Pair {
  FileDescriptor ours, theirs;
};

Pair socket_pair() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    fail("the sockets of baraka-holder");
  }
  Pair pair{FileDescriptor(ends[0]), FileDescriptor(ends[1])};
  // Moved above the numbers to which its ends will be assigned.
  pair.theirs.reset(fcntl(ends[1], F_DUPFD_CLOEXEC, kEvents + 1));
  if (!pair.theirs.is_open()) fail("the sockets of baraka-holder");
  return pair;
}

class FileActions {
 public:
  FileActions() { posix_spawn_file_actions_init(&actions_); }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
  posix_spawn_file_actions_t* get() { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

class Attributes {
 public:
  /// A separate process group, so that Ctrl-C does not reach it, and no blocked signals.
  Attributes() {
    posix_spawnattr_init(&attributes_);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    posix_spawnattr_setpgroup(&attributes_, 0);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
  }
  ~Attributes() { posix_spawnattr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;
  const posix_spawnattr_t* get() const { return &attributes_; }

 private:
  posix_spawnattr_t attributes_{};
};

}  // namespace

Holder::Holder(const std::filesystem::path& program, const std::filesystem::path& folder) {
  Pair control = socket_pair();
  Pair events = socket_pair();
  FileActions actions;
  posix_spawn_file_actions_addopen(actions.get(), STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(actions.get(), STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(actions.get(), control.theirs.get(), kControl);
  posix_spawn_file_actions_adddup2(actions.get(), events.theirs.get(), kEvents);
  posix_spawn_file_actions_addclosefrom_np(actions.get(), kEvents + 1);
  if (!folder.empty()) posix_spawn_file_actions_addchdir_np(actions.get(), folder.c_str());
  const std::filesystem::path absolute = std::filesystem::absolute(program);
  const std::vector<std::string> words{absolute.string(), "hold", std::to_string(kControl),
                                       std::to_string(kEvents), std::to_string(getpid())};
  const Attributes attributes;
  const int error = posix_spawn(&process_, absolute.c_str(), actions.get(), attributes.get(),
                                pointers_to(words).data(), environ);
  if (error != 0) fail(fmt::format("cannot start {}", absolute.string()), error);
  control_ = std::move(control.ours);
  events_ = std::move(events.ours);
}

Holder::~Holder() {
  constexpr int kPatience = 15'000;  // ms, longer than init gives the programs
  const FileDescriptor process(static_cast<int>(syscall(SYS_pidfd_open, process_, 0)));
  // Init closes the socket of events when it ends, and the holder ends after init.
  pollfd ended{process.get(), POLLIN, 0};
  while (poll(&ended, 1, kPatience) < 0 && errno == EINTR) continue;
  if ((ended.revents & POLLIN) == 0) kill(process_, SIGKILL);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

std::filesystem::path installed_file(const std::filesystem::path& folder, const char* name) {
  const auto own = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  std::vector<std::filesystem::path> folders{folder};
  if (folder.empty()) folders = {own, own.parent_path() / "lib/baraka"};
  for (const std::filesystem::path& one : folders) {
    std::error_code error;
    if (std::filesystem::is_regular_file(one / name, error)) {
      return std::filesystem::absolute(one / name);
    }
  }
  throw std::runtime_error(
      fmt::format("{} is not in {}: it is installed with baraka", name, folders[0].string()));
}

}  // namespace programs::netns
