#include <aio.h>
#include <gtest/gtest.h>
#include <linux/futex.h>
#include <linux/sockios.h>
#include <mqueue.h>
#include <poll.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <threads.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "tests/unit/programs/preload/recorder/recorder.h"
#include "tests/unit/programs/preload/times.h"

// The factor is 0.25, from main.cpp: a program's 1 s is 4 s of the kernel. So are the origins.
namespace programs::preload {
namespace {

using Numbers = std::vector<std::int64_t>;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr std::int64_t kMonotonic = 1000 * kSecond;
constexpr std::int64_t kRealtime = 2000 * kSecond;
constexpr std::int64_t kRaw = 3000 * kSecond;
constexpr std::int64_t kBoot = 4000 * kSecond;

/// Three seconds of the program after the origin of a clock, and what the kernel is to be given.
const timespec kUntilRealtime = at(kRealtime + 3 * kSecond);
const timespec kUntilMonotonic = at(kMonotonic + 3 * kSecond);
const Numbers kKernelRealtime{kRealtime + 12 * kSecond};
const Numbers kKernelMonotonic{kMonotonic + 12 * kSecond};
/// Half a second, and a bit that is rounded.
const timespec kHalf = at(500 * kMillisecond);
const Numbers kKernelHalf{2 * kSecond};

/// What reaches the kernel of what `call` does.
Numbers passed_on(const std::function<void()>& call, const tests::recorder::Reaction& with = {}) {
  tests::recorder::arm(with);
  call();
  const std::vector<tests::recorder::Call> calls = tests::recorder::disarm();
  return calls.size() == 1 ? calls[0].times : Numbers{static_cast<std::int64_t>(calls.size()), -99};
}

struct TimedCall {
  const char* name;
  std::function<void()> call;
  Numbers expected;
};

std::string name_of(const testing::TestParamInfo<TimedCall>& call) { return call.param.name; }

class GivenMoments : public testing::TestWithParam<TimedCall> {};

TEST_P(GivenMoments, AreScaledFromTheOriginOfTheirClockAndDurationsByTheFactor) {
  EXPECT_EQ(passed_on(GetParam().call), GetParam().expected);
}

pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t condition = PTHREAD_COND_INITIALIZER;
pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;
sem_t semaphore;
mtx_t plain_mutex;
cnd_t plain_condition;

INSTANTIATE_TEST_SUITE_P(
    OfThreads, GivenMoments,
    testing::Values(
        TimedCall{
            "pthread_cond_clockwait_monotonic",
            [] { pthread_cond_clockwait(&condition, &mutex, CLOCK_MONOTONIC, &kUntilMonotonic); },
            kKernelMonotonic},
        TimedCall{
            "pthread_cond_clockwait_realtime",
            [] { pthread_cond_clockwait(&condition, &mutex, CLOCK_REALTIME, &kUntilRealtime); },
            kKernelRealtime},
        TimedCall{"pthread_mutex_timedlock",
                  [] { pthread_mutex_timedlock(&mutex, &kUntilRealtime); }, kKernelRealtime},
        TimedCall{"pthread_mutex_clocklock",
                  [] { pthread_mutex_clocklock(&mutex, CLOCK_MONOTONIC, &kUntilMonotonic); },
                  kKernelMonotonic},
        TimedCall{"pthread_rwlock_timedrdlock",
                  [] { pthread_rwlock_timedrdlock(&lock, &kUntilRealtime); }, kKernelRealtime},
        TimedCall{"pthread_rwlock_timedwrlock",
                  [] { pthread_rwlock_timedwrlock(&lock, &kUntilRealtime); }, kKernelRealtime},
        TimedCall{"pthread_rwlock_clockrdlock",
                  [] { pthread_rwlock_clockrdlock(&lock, CLOCK_MONOTONIC, &kUntilMonotonic); },
                  kKernelMonotonic},
        TimedCall{"pthread_rwlock_clockwrlock",
                  [] { pthread_rwlock_clockwrlock(&lock, CLOCK_MONOTONIC, &kUntilMonotonic); },
                  kKernelMonotonic},
        TimedCall{"pthread_timedjoin_np",
                  [] { pthread_timedjoin_np(pthread_self(), nullptr, &kUntilRealtime); },
                  kKernelRealtime},
        TimedCall{"pthread_clockjoin_np",
                  [] {
                    pthread_clockjoin_np(pthread_self(), nullptr, CLOCK_MONOTONIC,
                                         &kUntilMonotonic);
                  },
                  kKernelMonotonic},
        TimedCall{"sem_timedwait", [] { sem_timedwait(&semaphore, &kUntilRealtime); },
                  kKernelRealtime},
        TimedCall{"sem_clockwait",
                  [] { sem_clockwait(&semaphore, CLOCK_MONOTONIC, &kUntilMonotonic); },
                  kKernelMonotonic},
        TimedCall{"semtimedop",
                  [] {
                    sembuf one{};
                    semtimedop(0, &one, 1, &kHalf);
                  },
                  kKernelHalf},
        TimedCall{"mtx_timedlock", [] { mtx_timedlock(&plain_mutex, &kUntilRealtime); },
                  kKernelRealtime},
        TimedCall{"cnd_timedwait",
                  [] { cnd_timedwait(&plain_condition, &plain_mutex, &kUntilRealtime); },
                  kKernelRealtime},
        TimedCall{"mq_timedsend", [] { mq_timedsend(0, "", 0, 0, &kUntilRealtime); },
                  kKernelRealtime},
        TimedCall{"mq_timedreceive",
                  [] {
                    char c = 0;
                    mq_timedreceive(0, &c, 1, nullptr, &kUntilRealtime);
                  },
                  kKernelRealtime},
        TimedCall{"aio_suspend",
                  [] {
                    const aiocb* none[1] = {nullptr};
                    aio_suspend(none, 1, &kHalf);
                  },
                  kKernelHalf}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    OfSleeps, GivenMoments,
    testing::Values(TimedCall{"nanosleep", [] { nanosleep(&kHalf, nullptr); }, kKernelHalf},
                    TimedCall{"clock_nanosleep_for",
                              [] { clock_nanosleep(CLOCK_MONOTONIC, 0, &kHalf, nullptr); },
                              kKernelHalf},
                    TimedCall{"clock_nanosleep_until",
                              [] {
                                clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &kUntilMonotonic,
                                                nullptr);
                              },
                              kKernelMonotonic},
                    TimedCall{"clock_nanosleep_of_processor_time",
                              [] { clock_nanosleep(CLOCK_PROCESS_CPUTIME_ID, 0, &kHalf, nullptr); },
                              kKernelHalf},
                    TimedCall{"usleep", [] { usleep(500'000); }, kKernelHalf},
                    TimedCall{"sleep", [] { sleep(3); }, Numbers{12 * kSecond}},
                    TimedCall{"thrd_sleep", [] { thrd_sleep(&kHalf, nullptr); }, kKernelHalf}),
    name_of);

fd_set no_descriptors;

INSTANTIATE_TEST_SUITE_P(
    OfDescriptors, GivenMoments,
    testing::Values(
        TimedCall{"poll", [] { poll(nullptr, 0, 500); }, Numbers{2000}},
        TimedCall{"poll_for_ever", [] { poll(nullptr, 0, -1); }, Numbers{-1}},
        TimedCall{"poll_not_at_all", [] { poll(nullptr, 0, 0); }, Numbers{0}},
        TimedCall{"poll_longest", [] { poll(nullptr, 0, 2'000'000'000); }, Numbers{2'147'483'647}},
        TimedCall{"ppoll", [] { ppoll(nullptr, 0, &kHalf, nullptr); }, kKernelHalf},
        TimedCall{"ppoll_for_ever", [] { ppoll(nullptr, 0, nullptr, nullptr); },
                  Numbers{tests::recorder::kNone}},
        TimedCall{"select",
                  [] {
                    timeval half = at_us(500 * kMillisecond);
                    select(0, &no_descriptors, nullptr, nullptr, &half);
                  },
                  kKernelHalf},
        TimedCall{"select_for_ever", [] { select(0, &no_descriptors, nullptr, nullptr, nullptr); },
                  Numbers{tests::recorder::kNone}},
        TimedCall{"pselect", [] { pselect(0, &no_descriptors, nullptr, nullptr, &kHalf, nullptr); },
                  kKernelHalf},
        TimedCall{"epoll_wait",
                  [] {
                    epoll_event e;
                    epoll_wait(0, &e, 1, 500);
                  },
                  Numbers{2000}},
        TimedCall{"epoll_pwait",
                  [] {
                    epoll_event e;
                    epoll_pwait(0, &e, 1, 500, nullptr);
                  },
                  Numbers{2000}},
        TimedCall{"epoll_pwait2",
                  [] {
                    epoll_event e;
                    epoll_pwait2(0, &e, 1, &kHalf, nullptr);
                  },
                  kKernelHalf},
        TimedCall{"sigtimedwait",
                  [] {
                    sigset_t none;
                    sigemptyset(&none);
                    sigtimedwait(&none, nullptr, &kHalf);
                  },
                  kKernelHalf},
        TimedCall{"recvmmsg",
                  [] {
                    mmsghdr m{};
                    timespec given = kHalf;
                    recvmmsg(0, &m, 1, 0, &given);
                  },
                  kKernelHalf},
        TimedCall{"setsockopt_receive",
                  [] {
                    const timeval given = at_us(500 * kMillisecond);
                    setsockopt(0, SOL_SOCKET, SO_RCVTIMEO, &given, sizeof given);
                  },
                  kKernelHalf},
        TimedCall{"setsockopt_send",
                  [] {
                    const timeval given = at_us(500 * kMillisecond);
                    setsockopt(0, SOL_SOCKET, SO_SNDTIMEO, &given, sizeof given);
                  },
                  kKernelHalf},
        TimedCall{"setsockopt_of_another_kind",
                  [] {
                    const timeval given = at_us(500 * kMillisecond);
                    setsockopt(0, SOL_SOCKET, SO_LINGER, &given, sizeof given);
                  },
                  Numbers{500 * kMillisecond}}),
    name_of);

itimerspec timer(std::int64_t interval, std::int64_t first) { return {at(interval), at(first)}; }

/// Of a clock, set to go off at or after `first`, then every half second.
std::function<void()> set_descriptor(clockid_t clock, int flags, std::int64_t first) {
  return [=] {
    const int descriptor = timerfd_create(clock, 0);
    const itimerspec setting = timer(500 * kMillisecond, first);
    timerfd_settime(descriptor, flags, &setting, nullptr);
    close(descriptor);
  };
}

std::function<void()> set_timer(clockid_t clock, int flags, std::int64_t first) {
  return [=] {
    sigevent none{};
    none.sigev_notify = SIGEV_NONE;
    timer_t id = nullptr;
    ASSERT_EQ(timer_create(clock, &none, &id), 0);
    const itimerspec setting = timer(500 * kMillisecond, first);
    timer_settime(id, flags, &setting, nullptr);
    timer_delete(id);
  };
}

INSTANTIATE_TEST_SUITE_P(
    OfTimers, GivenMoments,
    testing::Values(
        TimedCall{"timerfd_after", set_descriptor(CLOCK_MONOTONIC, 0, 3 * kSecond),
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"timerfd_at_monotonic",
                  set_descriptor(CLOCK_MONOTONIC, TFD_TIMER_ABSTIME, kMonotonic + 3 * kSecond),
                  Numbers{2 * kSecond, kMonotonic + 12 * kSecond}},
        TimedCall{"timerfd_at_realtime",
                  set_descriptor(CLOCK_REALTIME, TFD_TIMER_ABSTIME, kRealtime + 3 * kSecond),
                  Numbers{2 * kSecond, kRealtime + 12 * kSecond}},
        TimedCall{"timerfd_at_boottime",
                  set_descriptor(CLOCK_BOOTTIME, TFD_TIMER_ABSTIME, kBoot + 3 * kSecond),
                  Numbers{2 * kSecond, kBoot + 12 * kSecond}},
        TimedCall{"timerfd_off", set_descriptor(CLOCK_MONOTONIC, TFD_TIMER_ABSTIME, 0),
                  Numbers{2 * kSecond, 0}},
        TimedCall{"timer_after", set_timer(CLOCK_REALTIME, 0, 3 * kSecond),
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"timer_at_monotonic",
                  set_timer(CLOCK_MONOTONIC, TIMER_ABSTIME, kMonotonic + 3 * kSecond),
                  Numbers{2 * kSecond, kMonotonic + 12 * kSecond}},
        TimedCall{"timer_of_processor_time", set_timer(CLOCK_PROCESS_CPUTIME_ID, 0, 3 * kSecond),
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"timer_at_processor_time",
                  set_timer(CLOCK_PROCESS_CPUTIME_ID, TIMER_ABSTIME, 3 * kSecond),
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"setitimer",
                  [] {
                    const itimerval given{at_us(500 * kMillisecond), at_us(3 * kSecond)};
                    setitimer(ITIMER_REAL, &given, nullptr);
                  },
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"setitimer_of_processor_time",
                  [] {
                    const itimerval given{at_us(500 * kMillisecond), at_us(3 * kSecond)};
                    setitimer(ITIMER_PROF, &given, nullptr);
                  },
                  Numbers{2 * kSecond, 12 * kSecond}},
        TimedCall{"alarm", [] { alarm(3); }, Numbers{0, 12 * kSecond}},
        TimedCall{"ualarm", [] { ualarm(3'000'000, 500'000); },
                  Numbers{2 * kSecond, 12 * kSecond}}),
    name_of);

template <class... T>
std::function<void()> ask_kernel(long number, T... arguments) {
  return [=] { syscall(number, arguments...); };
}

INSTANTIATE_TEST_SUITE_P(
    OfSystemCalls, GivenMoments,
    testing::Values(
        TimedCall{"futex_wait", ask_kernel(SYS_futex, nullptr, FUTEX_WAIT_PRIVATE, 0, &kHalf, 0, 0),
                  kKernelHalf},
        TimedCall{
            "futex_wait_bitset",
            ask_kernel(SYS_futex, nullptr, FUTEX_WAIT_BITSET_PRIVATE, 0, &kUntilMonotonic, 0, 0),
            kKernelMonotonic},
        TimedCall{"futex_wait_bitset_realtime",
                  ask_kernel(SYS_futex, nullptr, FUTEX_WAIT_BITSET_PRIVATE | FUTEX_CLOCK_REALTIME,
                             0, &kUntilRealtime, 0, 0),
                  kKernelRealtime},
        TimedCall{"futex_lock_pi",
                  ask_kernel(SYS_futex, nullptr, FUTEX_LOCK_PI, 0, &kUntilRealtime, 0, 0),
                  kKernelRealtime},
        TimedCall{"futex_wake", ask_kernel(SYS_futex, nullptr, FUTEX_WAKE, 1, 77L, 0, 0),
                  Numbers{77}},
        TimedCall{"nanosleep_call", ask_kernel(SYS_nanosleep, &kHalf, nullptr), kKernelHalf},
        TimedCall{"clock_nanosleep_call",
                  ask_kernel(SYS_clock_nanosleep, CLOCK_MONOTONIC, TIMER_ABSTIME, &kUntilMonotonic,
                             nullptr),
                  kKernelMonotonic},
        TimedCall{"poll_call", ask_kernel(SYS_poll, nullptr, 0, 500), Numbers{2000}},
        TimedCall{"ppoll_call", ask_kernel(SYS_ppoll, nullptr, 0, &kHalf, nullptr, 8), kKernelHalf},
        TimedCall{"pselect_call",
                  ask_kernel(SYS_pselect6, 0, nullptr, nullptr, nullptr, &kHalf, nullptr),
                  kKernelHalf},
        TimedCall{"epoll_pwait_call", ask_kernel(SYS_epoll_pwait, 0, nullptr, 1, 500, nullptr, 8),
                  Numbers{2000}},
        TimedCall{"epoll_pwait2_call",
                  ask_kernel(SYS_epoll_pwait2, 0, nullptr, 1, &kHalf, nullptr, 8), kKernelHalf},
        TimedCall{"rt_sigtimedwait_call",
                  ask_kernel(SYS_rt_sigtimedwait, nullptr, nullptr, &kHalf, 8), kKernelHalf},
        TimedCall{"of_no_time", ask_kernel(SYS_getpid), Numbers{}}),
    name_of);

/// Kernel's readings 8 s after the origin are the program's 2 s after it.
TEST(Clock, GoesSlowerFromItsOrigin) {
  const auto reads = [](clockid_t clock, std::int64_t kernel) {
    tests::recorder::set_clock(kernel);
    timespec now{};
    clock_gettime(clock, &now);
    tests::recorder::disarm();
    return ns(now);
  };
  EXPECT_EQ(reads(CLOCK_MONOTONIC, kMonotonic + 8 * kSecond), kMonotonic + 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_MONOTONIC_COARSE, kMonotonic + 8 * kSecond), kMonotonic + 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_REALTIME, kRealtime + 8 * kSecond), kRealtime + 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_REALTIME_COARSE, kRealtime + 8 * kSecond), kRealtime + 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_MONOTONIC_RAW, kRaw + 8 * kSecond), kRaw + 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_BOOTTIME, kBoot + 8 * kSecond), kBoot + 2 * kSecond);
}

/// Those of processor time begin at 0; those of other processes have negative numbers, as have
/// devices', which stay: clock_getcpuclockid(3), Documentation of posix-clock of Linux.
TEST(Clock, OfProcessorTimeGoesSlowerFromZero) {
  const auto reads = [](clockid_t clock) {
    tests::recorder::set_clock(8 * kSecond);
    timespec now{};
    clock_gettime(clock, &now);
    tests::recorder::disarm();
    return ns(now);
  };
  constexpr clockid_t kOfDescriptor3 = ~3 << 3 | 3;
  clockid_t of_parent = 0, of_thread = 0;
  ASSERT_EQ(clock_getcpuclockid(getppid(), &of_parent), 0);
  ASSERT_EQ(pthread_getcpuclockid(pthread_self(), &of_thread), 0);
  EXPECT_EQ(reads(CLOCK_PROCESS_CPUTIME_ID), 2 * kSecond);
  EXPECT_EQ(reads(CLOCK_THREAD_CPUTIME_ID), 2 * kSecond);
  EXPECT_EQ(reads(of_parent), 2 * kSecond);
  EXPECT_EQ(reads(of_thread), 2 * kSecond);
  EXPECT_EQ(reads(kOfDescriptor3), 8 * kSecond);
}

TEST(Clock, HasNotBeenSlowedBeforeItsOrigin) {
  tests::recorder::set_clock(kMonotonic - 8 * kSecond);
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  tests::recorder::disarm();
  EXPECT_EQ(ns(now), kMonotonic - 8 * kSecond);
}

TEST(Clock, AllCallsThatReadItAgree) {
  tests::recorder::set_clock(kRealtime + 10 * kSecond);
  timeval with_microseconds{};
  gettimeofday(&with_microseconds, nullptr);
  timespec by_c{};
  EXPECT_EQ(timespec_get(&by_c, TIME_UTC), TIME_UTC);
  time_t seconds = 0;
  EXPECT_EQ(time(&seconds), seconds);
  timespec by_call{};
  EXPECT_EQ(syscall(SYS_clock_gettime, CLOCK_REALTIME, &by_call), 0);
  tests::recorder::disarm();
  EXPECT_EQ(ns(with_microseconds), kRealtime + 2500 * kMillisecond);
  EXPECT_EQ(ns(by_c), kRealtime + 2500 * kMillisecond);
  EXPECT_EQ(ns(by_call), kRealtime + 2500 * kMillisecond);
  EXPECT_EQ(seconds, kRealtime / kSecond + 2);
}

/// The kernel says that 2 s are left, of a timer also 4 s between two times.
constexpr tests::recorder::Reaction kInterrupted{-1, EINTR, 2 * kSecond, 4 * kSecond};
constexpr tests::recorder::Reaction kLeft{0, 0, 2 * kSecond, 4 * kSecond};

TEST(TimeLeft, IsTheProgramsOwn) {
  timespec left{};
  passed_on([&left] { nanosleep(&kHalf, &left); }, kInterrupted);
  EXPECT_EQ(ns(left), 500 * kMillisecond);
  left = {};
  passed_on([&left] { clock_nanosleep(CLOCK_MONOTONIC, 0, &kHalf, &left); },
            {EINTR, 0, 2 * kSecond, 0});
  EXPECT_EQ(ns(left), 500 * kMillisecond);
  passed_on([] { EXPECT_EQ(sleep(3), 2U); }, {-1, EINTR, 8 * kSecond, 0});
  timeval rest = at_us(3 * kSecond);
  passed_on([&rest] { select(0, nullptr, nullptr, nullptr, &rest); }, kLeft);
  EXPECT_EQ(ns(rest), 500 * kMillisecond);
  timespec time = kHalf;
  passed_on(
      [&time] {
        mmsghdr m{};
        recvmmsg(0, &m, 0, 0, &time);
      },
      kLeft);
  EXPECT_EQ(ns(time), 500 * kMillisecond);
  timeval timeout{};
  socklen_t length = sizeof timeout;
  passed_on([&] { getsockopt(0, SOL_SOCKET, SO_RCVTIMEO, &timeout, &length); }, kLeft);
  EXPECT_EQ(ns(timeout), 500 * kMillisecond);
}

TEST(TimeLeft, OfTimersToo) {
  const auto is_dilated = [](const itimerspec& setting) {
    EXPECT_EQ(ns(setting.it_value), 500 * kMillisecond);
    EXPECT_EQ(ns(setting.it_interval), kSecond);
  };
  itimerspec before{};
  const itimerspec setting = timer(0, kSecond);
  passed_on([&] { timerfd_settime(0, 0, &setting, &before); }, kLeft);
  is_dilated(before);
  before = {};
  passed_on([&] { timerfd_gettime(0, &before); }, kLeft);
  is_dilated(before);
  before = {};
  passed_on([&] { timer_settime(nullptr, 0, &setting, &before); }, kLeft);
  is_dilated(before);
  before = {};
  passed_on([&] { timer_gettime(nullptr, &before); }, kLeft);
  is_dilated(before);
  itimerval old{};
  const itimerval now{{}, {1, 0}};
  passed_on([&] { setitimer(ITIMER_REAL, &now, &old); }, kLeft);
  EXPECT_EQ(ns(old.it_value), 500 * kMillisecond);
  old = {};
  passed_on([&] { getitimer(ITIMER_REAL, &old); }, kLeft);
  EXPECT_EQ(ns(old.it_interval), kSecond);
  passed_on([] { EXPECT_EQ(alarm(3), 1U) << "half a second, rounded up"; }, kLeft);
  passed_on([] { EXPECT_EQ(ualarm(3, 0), 500'000U); }, kLeft);
}

TEST(Mistakes, AreLeftToTheKernel) {
  const timespec wrong{0, 2'000'000'000};
  EXPECT_EQ(nanosleep(&wrong, nullptr), -1);
  EXPECT_EQ(errno, EINVAL);
  EXPECT_EQ(timerfd_settime(-1, 0, nullptr, nullptr), -1);
}

/// A message with one control message of the socket level.
struct Received {
  Received(int type, const void* value, std::size_t size) {
    cmsghdr header{};
    header.cmsg_len = CMSG_LEN(size);
    header.cmsg_level = SOL_SOCKET;
    header.cmsg_type = type;
    std::memcpy(control.data(), &header, sizeof header);
    std::memcpy(control.data() + CMSG_LEN(0), value, size);
    message.msg_control = control.data();
    message.msg_controllen = CMSG_SPACE(size);
  }
  template <class Value>
  Value value(std::size_t index = 0) const {
    Value result;
    std::memcpy(&result, control.data() + CMSG_LEN(0) + index * sizeof result, sizeof result);
    return result;
  }
  alignas(cmsghdr) std::array<char, 256> control{};
  msghdr message{};
};

TEST(Reception, TheKernelsTimestampsAreTheProgramsOwn) {
  constexpr std::int64_t kKernel = kRealtime + 8 * kSecond;
  constexpr std::int64_t kProgram = kRealtime + 2 * kSecond;
  const timeval coarse = at_us(kKernel);
  Received stamp(SO_TIMESTAMP, &coarse, sizeof coarse);
  passed_on([&] { recvmsg(0, &stamp.message, 0); });
  EXPECT_EQ(ns(stamp.value<timeval>()), kProgram);
  const std::array fine{at(kKernel), at(0), at(kKernel)};
  Received exact(SO_TIMESTAMPNS, fine.data(), sizeof(timespec));
  passed_on([&] { recvmsg(0, &exact.message, 0); });
  EXPECT_EQ(ns(exact.value<timespec>()), kProgram);
  Received three(SO_TIMESTAMPING, fine.data(), sizeof fine);
  mmsghdr several{three.message, 0};
  passed_on([&] { recvmmsg(0, &several, 1, 0, nullptr); }, {1, 0, 0, 0});
  EXPECT_EQ(ns(three.value<timespec>(0)), kProgram);
  EXPECT_EQ(ns(three.value<timespec>(2)), kKernel) << "the card's own clock";
  Received other(SCM_RIGHTS, fine.data(), sizeof(timespec));
  passed_on([&] { recvmsg(0, &other.message, 0); });
  EXPECT_EQ(ns(other.value<timespec>()), kKernel);
  timespec last{};
  passed_on([&] { ioctl(0, SIOCGSTAMPNS_OLD, &last); }, {0, 0, kKernel, 0});
  EXPECT_EQ(ns(last), kProgram);
  passed_on([&] { ioctl(0, FIONREAD, &last); }, {0, 0, kKernel, 0});
  EXPECT_EQ(ns(last), kKernel);
}

/// With the C library itself, whose own state tells the clock: at a factor below 1 it would be over
/// at once, or never, if the clock were taken for the other.
TEST(Condition, IsWaitedForByTheClockThatItWasMadeWith) {
  for (const clockid_t clock : {CLOCK_REALTIME, CLOCK_MONOTONIC}) {
    pthread_condattr_t attributes;
    pthread_condattr_init(&attributes);
    pthread_condattr_setclock(&attributes, clock);
    pthread_cond_t one;
    pthread_cond_init(&one, &attributes);
    timespec until{};
    clock_gettime(clock, &until);
    until = at(ns(until) + 20 * kMillisecond);
    pthread_mutex_lock(&mutex);
    EXPECT_EQ(pthread_cond_timedwait(&one, &mutex, &until), ETIMEDOUT);
    pthread_mutex_unlock(&mutex);
    timespec now{};
    clock_gettime(clock, &now);
    EXPECT_GE(ns(now), ns(until));
    pthread_cond_destroy(&one);
    pthread_condattr_destroy(&attributes);
  }
}

}  // namespace
}  // namespace programs::preload
