#include "gateway/runtime/fault_watch.h"

#include <cxxabi.h>
#include <fmt/format.h>
#include <signal.h>  // NOLINT(modernize-deprecated-headers): sigaction()
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <thread>
#include <typeinfo>
#include <utility>
#include <vector>

#include "hal/node/exchange/foreign_call.h"
#include "hal/types/printable.h"

// Code that runs in a signal handler allocates no memory and takes no lock: texts are formatted
// into arrays, from integers and texts only.

namespace gateway::runtime {
namespace {

/// By default each of these ends the process. SIGINT, SIGTERM, SIGHUP and SIGQUIT are not included,
/// because people end programs with them.
constexpr std::array kDeadlySignals{SIGSEGV, SIGBUS,  SIGFPE,    SIGILL,  SIGABRT, SIGSYS,
                                    SIGTRAP, SIGXCPU, SIGXFSZ,   SIGALRM, SIGPIPE, SIGVTALRM,
                                    SIGPROF, SIGIO,   SIGSTKFLT, SIGPWR,  SIGUSR1, SIGUSR2};
constexpr int kMostNaps = 500;                              // of 10 ms
constexpr std::size_t kSignalStack = std::size_t{1} << 17;  // bytes

enum class Told : std::uint8_t { kNothing, kTelling, kHeld, kOver };

/// A text of up to N - 1 bytes; longer texts are cut.
template <std::size_t N>
struct Line {
  std::array<char, N> bytes{};
  std::size_t size = 0;

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    const auto added = fmt::vformat_to_n(bytes.data() + size, N - size, fmt::string_view(format),
                                         fmt::make_format_args(args...));
    size = std::min(N, size + added.size);
  }
  std::string_view text() const { return {bytes.data(), size}; }
};

std::atomic<pid_t> watching{0};  ///< The watched process: a forked child has a copy of this memory.
std::atomic<Told> told{Told::kNothing};
bool holds = false;
thread_local bool has_signal_stack = false;
Line<128> prefix_of_lines;
Line<512> uncaught;  ///< The exception that is ending the process; empty: none.
Line<1024> fault;    ///< All that was reported, without the prefix.

bool comes_from_an_instruction(int signal, const siginfo_t& info) {
  const bool is_fault =
      signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL;
  return is_fault && info.si_code > 0;
}

void add_cause(int signal, const siginfo_t& info) {
  if (uncaught.size > 0) return fault.add("{}", uncaught.text());
  const char* const name = ::sigabbrev_np(signal);
  const char* const words = ::sigdescr_np(signal);
  fault.add("SIG{} ({})", name == nullptr ? "?" : name, words == nullptr ? "?" : words);
  if (comes_from_an_instruction(signal, info)) {
    fault.add(" at address {}", static_cast<const void*>(info.si_addr));
  } else if (info.si_code <= 0 && info.si_pid != ::getpid() && info.si_pid > 0) {
    fault.add(" from process {}", info.si_pid);
  }
}

void add_time(hal::Time at) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  const std::int64_t ns = at.time_since_epoch().count();
  fault.add(" at {}.{:09} s", ns / kSecond, ns % kSecond);
}

/// Writes into `fault` what happened in which call. @param seized  the current call, of any thread.
void describe(int signal, const siginfo_t& info, const hal::node::exchange::ForeignCall* own,
              const std::optional<hal::node::exchange::SeizedCall>& seized) {
  fault.size = 0;
  if (own != nullptr) {
    fault.add("{}: ", own->who());
    add_cause(signal, info);
    fault.add(" in {}", own->what());
    return add_time(own->at());
  }
  add_cause(signal, info);
  if (!seized) return fault.add(" outside any call of a controller");
  fault.add(" on another thread during {} of {}", seized->what, seized->who);
  add_time(seized->at);
}

void tell() {
  Line<sizeof(prefix_of_lines.bytes) + sizeof(fault.bytes) + 8> line;
  line.add("{}: {}\n", prefix_of_lines.text(), fault.text());
  std::string_view rest = line.text();
  while (!rest.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, rest.data(), rest.size());
    if (written <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// Holds this thread until the results are written.
void hold() {
  told = Told::kHeld;
  constexpr timespec kNap{0, 10'000'000};  // ns
  for (int nap = 0; nap < kMostNaps && told != Told::kOver; ++nap) ::nanosleep(&kNap, nullptr);
}

void on_signal(int signal, siginfo_t* info, void* context) {
  (void)context;
  const int error = errno;
  const hal::node::exchange::ForeignCall* const own = hal::node::exchange::call_of_this_thread();
  const bool is_told = ::getpid() == watching && (signal != SIGPIPE || own != nullptr);
  Told nothing = Told::kNothing;
  if (is_told && told.compare_exchange_strong(nothing, Told::kTelling)) {
    const auto seized = hal::node::exchange::seize_call();
    describe(signal, *info, own, seized);
    tell();
    if (holds && seized) hold();
  } else if (is_told) {
    while (true) ::pause();  // another thread's fault is ending the process
  }
  errno = error;
  // The handler is removed now (SA_RESETHAND): the instruction fails again, or the signal is raised
  // again.
  if (!comes_from_an_instruction(signal, *info)) ::raise(signal);
}

/// Reports "uncaught exception std::runtime_error: TEXT".
void on_terminate() {
  try {
    const std::exception_ptr thrown = std::current_exception();
    if (!thrown) {
      uncaught.add("std::terminate()");
      std::abort();
    }
    int status = 0;
    const std::unique_ptr<char, void (*)(void*)> name(
        abi::__cxa_demangle(abi::__cxa_current_exception_type()->name(), nullptr, nullptr, &status),
        std::free);
    uncaught.add("uncaught exception {}", name ? name.get() : "of an unknown type");
    std::rethrow_exception(thrown);
  } catch (const std::exception& e) {
    uncaught.add(": {}", hal::printable(e.what()));
  } catch (...) {  // NOLINT(bugprone-empty-catch): its type is all that there is to say
  }
  std::abort();
}

}  // namespace

/// The previous handlers.
struct FaultWatch::Handlers {
  std::vector<std::pair<int, struct sigaction>> actions;
  std::terminate_handler terminate = nullptr;
};

SignalStack::SignalStack() {
  if (std::exchange(has_signal_stack, true)) return;
  bytes_.resize(kSignalStack);
  const stack_t stack{.ss_sp = bytes_.data(), .ss_flags = 0, .ss_size = bytes_.size()};
  ::sigaltstack(&stack, &before_);
}

SignalStack::~SignalStack() {
  if (bytes_.empty()) return;
  ::sigaltstack(&before_, nullptr);
  has_signal_stack = false;
}

FaultWatch::FaultWatch(std::string_view prefix, bool held)
    : handlers_(std::make_unique<Handlers>()) {
  watching = ::getpid();
  told = Told::kNothing;
  holds = held;
  prefix_of_lines.size = uncaught.size = 0;
  prefix_of_lines.add("{}", hal::printable(prefix));
  handlers_->terminate = std::set_terminate(on_terminate);
  struct sigaction action {};
  action.sa_sigaction = on_signal;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  ::sigfillset(&action.sa_mask);
  for (const int signal : kDeadlySignals) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if ((before.sa_flags & SA_SIGINFO) != 0 || before.sa_handler != SIG_DFL) continue;
    ::sigaction(signal, &action, nullptr);
    handlers_->actions.emplace_back(signal, before);
  }
}

FaultWatch::~FaultWatch() {
  for (const auto& [signal, before] : handlers_->actions) ::sigaction(signal, &before, nullptr);
  std::set_terminate(handlers_->terminate);
}

std::optional<std::string> FaultWatch::held_fault() {
  if (told != Told::kHeld) return std::nullopt;
  return std::string(fault.text());
}

void FaultWatch::end() {
  told = Told::kOver;
  while (true) std::this_thread::sleep_for(std::chrono::hours(1));
}

}  // namespace gateway::runtime
