// Time-outs of sockets, and time stamps of received packets: socket(7), recvmmsg(2),
// Documentation/networking/timestamping.rst of Linux.
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdarg>
#include <cstring>

#include "programs/preload/converted.h"
#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"

namespace {

using programs::preload::ForKernel;
using programs::preload::is_time;
using programs::preload::Nanoseconds;
using programs::preload::ProcessTime;

// On machines with 64 bits the old and the new numbers mean the same.
bool is_timeout(int level, int option) {
  return level == SOL_SOCKET && (option == SO_RCVTIMEO_OLD || option == SO_RCVTIMEO_NEW ||
                                 option == SO_SNDTIMEO_OLD || option == SO_SNDTIMEO_NEW);
}

Nanoseconds received_at(Nanoseconds kernel) {
  return ProcessTime::get().to_program(kernel, CLOCK_REALTIME);
}

/// Converts the time at which something was received; zero: there is none.
void convert(timespec& moment) {
  if (moment.tv_sec == 0 && moment.tv_nsec == 0) return;
  moment = programs::preload::to_timespec(received_at(programs::preload::nanoseconds(moment)));
}

void convert(timeval& moment) {
  moment = programs::preload::to_timeval(received_at(programs::preload::nanoseconds(moment)));
}

/// Converts the first value in a control message's data.
template <class Value>
void convert_first(cmsghdr& control) {
  Value value;
  if (control.cmsg_len < CMSG_LEN(sizeof value)) return;
  std::memcpy(&value, CMSG_DATA(&control), sizeof value);
  convert(value);
  std::memcpy(CMSG_DATA(&control), &value, sizeof value);
}

void convert_timestamps(msghdr& message) {
  for (cmsghdr* control = CMSG_FIRSTHDR(&message); control != nullptr;
       control = CMSG_NXTHDR(&message, control)) {
    if (control->cmsg_level != SOL_SOCKET) continue;
    switch (control->cmsg_type) {
      case SO_TIMESTAMP_OLD:
      case SO_TIMESTAMP_NEW:
        convert_first<timeval>(*control);
        break;
      case SO_TIMESTAMPNS_OLD:
      case SO_TIMESTAMPNS_NEW:
      // Three times; the second and third are of the device's own clock.
      case SO_TIMESTAMPING_OLD:
      case SO_TIMESTAMPING_NEW:
        convert_first<timespec>(*control);
        break;
      default:
        break;
    }
  }
}

}  // namespace

BARAKA_EXPORTED int setsockopt(int socket, int level, int option, const void* value,
                               socklen_t length) noexcept {
  timeval timeout{};
  if (!is_timeout(level, option) || value == nullptr || length < sizeof timeout) {
    return BARAKA_NEXT(setsockopt)(socket, level, option, value, length);
  }
  std::memcpy(&timeout, value, sizeof timeout);
  if (is_time(&timeout)) {
    const Nanoseconds asked = programs::preload::nanoseconds(timeout);
    timeout = programs::preload::to_timeval_up(ProcessTime::get().dilation().to_kernel(asked));
  }
  return BARAKA_NEXT(setsockopt)(socket, level, option, &timeout, sizeof timeout);
}

BARAKA_EXPORTED int getsockopt(int socket, int level, int option, void* __restrict value,
                               socklen_t* __restrict length) noexcept {
  const int status = BARAKA_NEXT(getsockopt)(socket, level, option, value, length);
  timeval timeout{};
  if (status != 0 || !is_timeout(level, option) || *length < sizeof timeout) return status;
  std::memcpy(&timeout, value, sizeof timeout);
  timeout = programs::preload::for_program(timeout);
  std::memcpy(value, &timeout, sizeof timeout);
  return status;
}

BARAKA_EXPORTED ssize_t recvmsg(int socket, msghdr* message, int flags) {
  const ssize_t length = BARAKA_NEXT(recvmsg)(socket, message, flags);
  if (length >= 0) convert_timestamps(*message);
  return length;
}

/// Linux writes the remaining time back.
BARAKA_EXPORTED int recvmmsg(int socket, mmsghdr* messages, unsigned count, int flags,
                             timespec* timeout) {
  const auto kernel = ForKernel::duration(timeout);
  timespec left{};
  if (timeout != nullptr) left = *kernel.get();
  const int received =
      BARAKA_NEXT(recvmmsg)(socket, messages, count, flags, timeout != nullptr ? &left : nullptr);
  for (int i = 0; i < received; ++i) convert_timestamps(messages[i].msg_hdr);
  if (timeout != nullptr && is_time(&left)) *timeout = programs::preload::for_program(left);
  return received;
}

BARAKA_EXPORTED int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  const int status = BARAKA_NEXT(ioctl)(descriptor, request, argument);
  if (status != 0) return status;
  if (request == SIOCGSTAMP_OLD || request == SIOCGSTAMP_NEW) {
    convert(*static_cast<timeval*>(argument));
  } else if (request == SIOCGSTAMPNS_OLD || request == SIOCGSTAMPNS_NEW) {
    convert(*static_cast<timespec*>(argument));
  }
  return status;
}
