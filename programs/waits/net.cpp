#include "programs/waits/net.h"

#include <link.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "programs/preload/let_pass.h"
#include "programs/waits/handlers.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/turn.h"

#ifndef __x86_64__
#error "the registers of a system call are known for x86-64 only"
#endif

extern "C" void return_from_handler();

// How the kernel returns from the handler: rt_sigreturn, by an instruction that the net lets pass.
// Those who unwind the stack (debuggers, libgcc) know a signal's frame by just these two.
__asm__(
    ".text\n.local return_from_handler\n.type return_from_handler, @function\n"
    "return_from_handler:\n  mov $15, %rax\n  syscall\n");

namespace programs::waits {
namespace {

constexpr char kPass = 0, kCatch = 1;  // SYSCALL_DISPATCH_FILTER_ALLOW, _BLOCK
constexpr int kSetDispatch = 59, kOn = 1;
constexpr int kDispatched = 2;  // si_code: SYS_USER_DISPATCH

__attribute__((tls_model("initial-exec"))) thread_local volatile char selector = kPass;

/// The instructions of this library.
struct Code {
  std::uintptr_t begin = 0;
  std::size_t size = 0;
};

/// Of the library that has `code.begin` somewhere.
int find_code(dl_phdr_info* library, std::size_t, void* given) {
  auto& code = *static_cast<Code*>(given);
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& part = library->dlpi_phdr[i];
    const std::uintptr_t begin = library->dlpi_addr + part.p_vaddr;
    const bool is_here = part.p_type == PT_LOAD && (part.p_flags & PF_X) != 0 &&
                         code.begin >= begin && code.begin < begin + part.p_memsz;
    if (!is_here) continue;
    code = {begin, part.p_memsz};
    return 1;
  }
  return 0;
}

const Code& own_code() {
  static Code code;
  if (code.size == 0) {
    code.begin = reinterpret_cast<std::uintptr_t>(&return_from_handler);
    dl_iterate_phdr(find_code, &code);
  }
  return code;
}

/// As the kernel takes it; the C library puts its own restorer into it.
struct KernelAction {
  SignalHandler handler;
  unsigned long flags;
  void (*restorer)();
  std::uint64_t mask;
};

constexpr std::uint64_t bit_of(int signal) { return std::uint64_t{1} << (signal - 1); }

/// A thread that blocks SIGSYS dies of the next call that is caught, so it stays open. The set that
/// holds after the handler is that of its context.
long set_mask(ucontext_t& context, const Arguments& a) {
  std::uint64_t mask = 0;
  std::memcpy(&mask, &context.uc_sigmask, sizeof mask);
  auto* const set = pointer<const std::uint64_t>(a[1]);
  auto* const before = pointer<std::uint64_t>(a[2]);
  const std::uint64_t given = set == nullptr ? 0 : *set;
  if (before != nullptr) *before = mask;
  if (set == nullptr) return 0;
  switch (a[0]) {
    case SIG_BLOCK:
      mask |= given;
      break;
    case SIG_UNBLOCK:
      mask &= ~given;
      break;
    case SIG_SETMASK:
      mask = given;
      break;
    default:
      return -EINVAL;
  }
  mask &= ~bit_of(SIGSYS);
  std::memcpy(&context.uc_sigmask, &mask, sizeof mask);
  return 0;
}

constexpr unsigned long kRestorer = 0x04000000;  // SA_RESTORER

/// The C library's way back from a handler is a system call as well, which must not be caught: the
/// frame of the handler of SIGSYS would be taken for that of the program's handler. Nor may a
/// handler block SIGSYS: the thread would die of its first call that is caught.
long set_action(const Arguments& a) {
  const auto signal = static_cast<int>(a[0]);
  const bool is_set = a[1] != 0;
  if (is_set && (signal == SIGSYS || signal == kEndWait)) return 0;
  KernelAction action{}, before{};
  long result = kernel_call(SYS_rt_sigaction, {a[0], 0, reinterpret_cast<long>(&before), a[3]});
  if (result != 0) return result;
  before.handler = given_handler(signal, before.handler);
  if (is_set) {
    action = *pointer<const KernelAction>(a[1]);
    if ((action.flags & kRestorer) != 0) action.restorer = return_from_handler;
    action.mask &= ~bit_of(SIGSYS);
    action.handler = put_handler(signal, action.handler, action.flags);
    result = kernel_call(SYS_rt_sigaction, {a[0], reinterpret_cast<long>(&action), 0, a[3]});
  }
  if (result == 0 && a[2] != 0) *pointer<KernelAction>(a[2]) = before;
  return result;
}

/// Of those that programs make often: they ask, or change this process alone.
bool wakes_nobody(long number) {
  switch (number) {
    case SYS_mmap:
    case SYS_munmap:
    case SYS_mremap:
    case SYS_mprotect:
    case SYS_madvise:
    case SYS_brk:
    case SYS_getpid:
    case SYS_gettid:
    case SYS_fstat:
    case SYS_newfstatat:
    case SYS_lseek:
    case SYS_getsockname:
    case SYS_getpeername:
    case SYS_sched_yield:
    case SYS_rt_sigaction:
    case SYS_rt_sigprocmask:
      return true;
    default:
      return false;
  }
}

long as_kernel(long result) { return result == -1 ? -errno : result; }

long answer_caught(ucontext_t& context) {
  const auto& registers = context.uc_mcontext.gregs;
  const auto number = static_cast<long>(registers[REG_RAX]);
  const Arguments arguments{
      static_cast<long>(registers[REG_RDI]), static_cast<long>(registers[REG_RSI]),
      static_cast<long>(registers[REG_RDX]), static_cast<long>(registers[REG_R10]),
      static_cast<long>(registers[REG_R8]),  static_cast<long>(registers[REG_R9])};
  if (number == SYS_rt_sigprocmask) return set_mask(context, arguments);
  if (number == SYS_rt_sigaction) return set_action(arguments);
  return as_kernel(answer(number, arguments));
}

/// As a system call, which leaves errno to the C library.
void on_system_call(int, siginfo_t* info, void* given) {
  if (info->si_code != kDispatched) return;
  const int kept = errno;
  auto& context = *static_cast<ucontext_t*>(given);
  selector = kPass;
  context.uc_mcontext.gregs[REG_RAX] = answer_caught(context);
  errno = kept;
  selector = kCatch;
}

}  // namespace

long kernel_call(long number, const Arguments& a) {
  if (!wakes_nobody(number)) stir();
  long result = number;
  register long fourth __asm__("r10") = a[3];
  register long fifth __asm__("r8") = a[4];
  register long sixth __asm__("r9") = a[5];
  __asm__ volatile("syscall"
                   : "+a"(result)
                   : "D"(a[0]), "S"(a[1]), "d"(a[2]), "r"(fourth), "r"(fifth), "r"(sixth)
                   : "rcx", "r11", "memory");
  return result;
}

void set_handler(int signal, SignalHandler handler) {
  const KernelAction action{handler, SA_SIGINFO | SA_NODEFER | kRestorer, return_from_handler, 0};
  kernel_call(SYS_rt_sigaction,
              {signal, reinterpret_cast<long>(&action), 0, sizeof action.mask, 0, 0});
}

void catch_system_calls() {
  static std::atomic<bool> has_handler = false;
  if (!has_handler.exchange(true)) set_handler(SIGSYS, on_system_call);
  const std::uint64_t signal = bit_of(SIGSYS);
  kernel_call(SYS_rt_sigprocmask,
              {SIG_UNBLOCK, reinterpret_cast<long>(&signal), 0, sizeof signal, 0, 0});
  const Code& code = own_code();
  kernel_call(SYS_prctl,
              {kSetDispatch, kOn, static_cast<long>(code.begin), static_cast<long>(code.size),
               reinterpret_cast<long>(const_cast<char*>(&selector)), 0});
  selector = kCatch;
}

}  // namespace programs::waits

namespace programs::preload {

LetPass::LetPass(Effect effect) : before_(waits::selector) {
  if (effect == Effect::kMayWake) waits::stir();
  waits::selector = waits::kPass;
}
LetPass::~LetPass() { waits::selector = before_; }

}  // namespace programs::preload
