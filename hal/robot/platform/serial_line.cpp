#include "hal/robot/platform/serial_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

#include "hal/robot/platform/boot_time.h"

namespace hal::robot::platform {
namespace {

constexpr std::size_t kLongestLine = 1024;
constexpr Duration kDrainPoll = std::chrono::milliseconds{1};

tl::unexpected<Error> failed(const std::string& what) {
  return fail(Errc::kNotConnected, fmt::format("{}: {}", what, std::strerror(errno)));
}

bool configure(int descriptor) {
  termios line{};
  if (::tcgetattr(descriptor, &line) != 0) return false;
  ::cfmakeraw(&line);
  line.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  line.c_cflag |= CLOCAL | CREAD;
  line.c_cc[VMIN] = 0;
  line.c_cc[VTIME] = 0;
  return ::cfsetispeed(&line, B57600) == 0 && ::cfsetospeed(&line, B57600) == 0 &&
         ::tcsetattr(descriptor, TCSANOW, &line) == 0;
}

}  // namespace

Result<void> SerialLine::open(const std::string& device) {
  close();
  descriptor_ = ::open(device.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) return failed(device);
  if (!configure(descriptor_)) {
    const auto error = failed(device);
    close();
    return error;
  }
  (void)::ioctl(descriptor_, TIOCEXCL);  // best effort: some devices do not support it
  ::tcflush(descriptor_, TCIOFLUSH);
  return {};
}

void SerialLine::close() {
  forget_unsent();
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  received_.clear();
}

Result<void> SerialLine::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t sent = ::write(descriptor_, text.data(), text.size());
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return failed("serial line");
    if (sent == 0) return fail(Errc::kNotConnected, "serial line: takes no more");
    text.remove_prefix(static_cast<std::size_t>(sent));
  }
  return {};
}

Result<std::optional<std::string>> SerialLine::read(Duration at_most) {
  const auto end = BootClock::now() + at_most;
  while (true) {
    if (auto line = take_line()) return line;
    if (received_.size() > kLongestLine) {
      received_.clear();
      return fail(Errc::kProtocol,
                  fmt::format("more than {} bytes without an end of line", kLongestLine));
    }
    const Duration left = std::max(Duration{}, Duration{end - BootClock::now()});
    const auto came = receive(left);
    if (!came) return tl::unexpected<Error>(came.error());
    if (!*came) return std::optional<std::string>{};
  }
}

/// @return whether bytes were received.
Result<bool> SerialLine::receive(Duration at_most) {
  pollfd waiting{.fd = descriptor_, .events = POLLIN, .revents = 0};
  const auto ms = std::chrono::ceil<std::chrono::milliseconds>(at_most);
  const int ready = ::poll(&waiting, 1, static_cast<int>(ms.count()));
  if (ready < 0 && errno != EINTR) return failed("serial line");
  if (ready <= 0) return false;
  std::array<char, 256> bytes{};
  const ssize_t size = ::read(descriptor_, bytes.data(), bytes.size());
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
  if (size < 0) return failed("serial line");
  if (size == 0) return fail(Errc::kNotConnected, "serial line: hung up");
  received_.append(bytes.data(), static_cast<std::size_t>(size));
  return true;
}

std::optional<std::string> SerialLine::take_line() {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = received_.substr(0, end);
  received_.erase(0, end + 1);
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

std::size_t SerialLine::unsent() const {
  int bytes = 0;
  if (descriptor_ < 0 || ::ioctl(descriptor_, TIOCOUTQ, &bytes) != 0) return 0;
  return static_cast<std::size_t>(std::max(bytes, 0));
}

void SerialLine::forget_unsent() {
  if (unsent() > 0) ::tcflush(descriptor_, TCOFLUSH);
}

/// Polls, because tcdrain(3) would block for ever on a stuck line.
void SerialLine::drain(Duration at_most) const {
  const BootTime end = BootClock::now() + at_most;
  while (unsent() > 0 && BootClock::now() < end) std::this_thread::sleep_for(kDrainPoll);
}

}  // namespace hal::robot::platform
