#include "programs/lockstep/kernel_needs.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/futex.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "programs/netns/descriptor.h"
#include "programs/netns/pipe.h"

namespace programs::lockstep {
namespace {

/// Errors of what the child tried by itself; 0: it works.
struct Tried {
  int dispatch = 0, futex = 0;
};

/// As programs are: in a user namespace of its own, if there may be one.
[[noreturn]] void be_looked_at(int report) {
  constexpr int kSetDispatch = 59, kOn = 1;  // PR_SET_SYSCALL_USER_DISPATCH
  static volatile char selector = 0;         // SYSCALL_DISPATCH_FILTER_ALLOW
  static std::uint32_t word = 0;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  (void)unshare(CLONE_NEWUSER);
  Tried tried;
  if (prctl(kSetDispatch, kOn, 0, 0, &selector) != 0) tried.dispatch = errno;
  if (syscall(SYS_futex, &word, FUTEX_WAKE, 1, nullptr, nullptr, 0) < 0) tried.futex = errno;
  (void)!write(report, &tried, sizeof tried);
  for (;;) poll(nullptr, 0, -1);
}

/// A process that sleeps in poll(2).
class Sleeper {
 public:
  Sleeper() {
    netns::Pipe report;
    process_ = fork();
    if (process_ < 0) netns::fail("a process to look at");
    if (process_ == 0) be_looked_at(report.writer.get());
    report.writer.reset();
    const std::string said = netns::all_from(report.reader, sizeof tried_);
    if (said.size() == sizeof tried_) std::memcpy(&tried_, said.data(), sizeof tried_);
  }
  ~Sleeper() {
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  Sleeper(const Sleeper&) = delete;
  Sleeper& operator=(const Sleeper&) = delete;

  pid_t process() const { return process_; }
  const Tried& tried() const { return tried_; }

 private:
  pid_t process_ = -1;
  Tried tried_;
};

struct Content {
  int error = 0;
  std::string text;
};

Content content_of(pid_t process, const char* name) {
  const std::string path = fmt::format("/proc/{0}/task/{0}/{1}", process, name);
  const netns::FileDescriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 128> text{};
  const ssize_t length = file.is_open() ? read(file.get(), text.data(), text.size()) : -1;
  if (length < 0) return {errno, {}};
  return {0, std::string(text.data(), static_cast<std::size_t>(length))};
}

/// Reads a file of the sleeper until it says what it has to of a thread that sleeps.
/// @return what is wrong; empty: nothing.
std::string complaint(pid_t process, const char* name,
                      const std::function<bool(const std::string&)>& is_as_needed) {
  constexpr int kTries = 1000;
  constexpr timespec kBetween{0, 1'000'000};
  Content content;
  for (int tries = 0; tries < kTries; ++tries) {
    content = content_of(process, name);
    if (content.error != 0) return std::strerror(content.error);
    if (is_as_needed(content.text)) return {};
    nanosleep(&kBetween, nullptr);
  }
  return fmt::format("it says '{}' of a thread that sleeps in poll(2)",
                     content.text.substr(0, content.text.find('\n')));
}

/// @return an error; 0: it works.
int try_descriptors(pid_t process) {
  const netns::FileDescriptor handle(static_cast<int>(syscall(SYS_pidfd_open, process, 0)));
  if (!handle.is_open()) return errno;
  const netns::FileDescriptor file(static_cast<int>(syscall(SYS_pidfd_getfd, handle.get(), 0, 0)));
  return file.is_open() || errno == EBADF ? 0 : errno;
}

}  // namespace

void require_kernel() {
  const Sleeper sleeper;
  std::vector<std::string> missing;
  const auto note = [&missing](const char* what, const std::string& why) {
    if (!why.empty()) missing.push_back(fmt::format("{}: {}", what, why));
  };
  const auto text_of = [](int error) { return error == 0 ? "" : std::strerror(error); };
  note("Syscall User Dispatch (Linux 5.11 or later)", text_of(sleeper.tried().dispatch));
  note("futex(2)", text_of(sleeper.tried().futex));
  note("/proc/PID/wchan (CONFIG_KALLSYMS)",
       complaint(sleeper.process(), "wchan",
                 [](const std::string& text) { return text.find("poll") != std::string::npos; }));
  note("/proc/PID/syscall (kernel.yama.ptrace_scope below 3)",
       complaint(sleeper.process(), "syscall", [](const std::string& text) {
         return text.starts_with(fmt::format("{} ", SYS_poll));
       }));
  note("pidfd_getfd(2) (Linux 5.6 or later)", text_of(try_descriptors(sleeper.process())));
  if (missing.empty()) return;
  throw std::runtime_error(
      fmt::format("lock-step needs of the kernel what is missing here: {}; run in real time "
                  "(--pace realtime)",
                  fmt::join(missing, "; ")));
}

}  // namespace programs::lockstep
