#include "hal/robot/platform/serial_line.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cstdarg>
#include <cstdlib>
#include <string>

namespace {

/// Bytes that a line seems to hold back: a pseudo-terminal holds none. Below 0: as it is.
int stuck_bytes = -1;
int flushed = 0;

}  // namespace

// In place of the C library's, for this program.
extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list arguments;
  va_start(arguments, request);
  void* const argument = va_arg(arguments, void*);
  va_end(arguments);
  if (request == TIOCOUTQ && stuck_bytes >= 0) {
    *static_cast<int*>(argument) = stuck_bytes;
    return 0;
  }
  return static_cast<int>(::syscall(SYS_ioctl, descriptor, request, argument));
}
extern "C" int tcflush(int descriptor, int queue) noexcept {
  if (queue == TCOFLUSH) ++flushed;
  return static_cast<int>(::syscall(SYS_ioctl, descriptor, TCFLSH, queue));
}

namespace hal::robot::platform {
namespace {

using namespace std::chrono_literals;

/// A pseudo-terminal: the test holds the far end.
class SerialLineTest : public testing::Test {
 protected:
  void SetUp() override {
    far_ = ::posix_openpt(O_RDWR | O_NOCTTY);
    ASSERT_GE(far_, 0) << "no pseudo-terminals: is /dev/pts mounted?";
    ASSERT_EQ(::grantpt(far_), 0);
    ASSERT_EQ(::unlockpt(far_), 0);
    device_ = ::ptsname(far_);
  }
  ~SerialLineTest() override { hang_up(); }

  void hang_up() {
    if (far_ >= 0) ::close(far_);
    far_ = -1;
  }
  void say(const std::string& text) const {
    ASSERT_EQ(::write(far_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  std::string heard() const {
    std::array<char, 256> bytes{};
    const ssize_t size = ::read(far_, bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
  }

  int far_ = -1;
  std::string device_;
  SerialLine line_;
};

TEST_F(SerialLineTest, IsRawAt57600Baud) {
  ASSERT_TRUE(line_.open(device_));
  const int descriptor = ::open(device_.c_str(), O_RDWR | O_NOCTTY);
  termios settings{};
  ASSERT_EQ(::tcgetattr(far_, &settings), 0);
  ::close(descriptor);
  EXPECT_EQ(::cfgetospeed(&settings), static_cast<speed_t>(B57600));
  EXPECT_EQ(::cfgetispeed(&settings), static_cast<speed_t>(B57600));
  EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_EQ(settings.c_cflag & (PARENB | CSTOPB), 0U);
  EXPECT_EQ(settings.c_lflag & (ICANON | ECHO), 0U);
}

TEST_F(SerialLineTest, GivesWholeLinesOnly) {
  ASSERT_TRUE(line_.open(device_));
  say("V 1");
  EXPECT_EQ(*line_.read(10ms), std::nullopt);
  say(" 2 3 \r\nOK\nV");
  EXPECT_EQ(*line_.read(1s), "V 1 2 3 ");
  EXPECT_EQ(*line_.read(1s), "OK");
  EXPECT_EQ(*line_.read(0ms), std::nullopt);
}

TEST_F(SerialLineTest, WritesBytesAsTheyAre) {
  ASSERT_TRUE(line_.open(device_));
  ASSERT_TRUE(line_.write("SV 1 2 3 \n"));
  EXPECT_EQ(heard(), "SV 1 2 3 \n");
}

TEST_F(SerialLineTest, BytesWithoutAnEndAreRefusedAndForgotten) {
  ASSERT_TRUE(line_.open(device_));
  say(std::string(2000, 'x'));
  const auto endless = line_.read(1s);
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, Errc::kProtocol);
  say("\nOK\n");
  for (int i = 0; i < 3; ++i) {
    if (*line_.read(1s) == "OK") return;
  }
  ADD_FAILURE() << "the next line was lost";
}

TEST_F(SerialLineTest, NoticesThatTheFarEndIsGone) {
  ASSERT_TRUE(line_.open(device_));
  hang_up();
  const auto read = line_.read(1s);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, Errc::kNotConnected);
  EXPECT_FALSE(line_.write("x"));
}

TEST_F(SerialLineTest, ThatIsStuckHoldsNobodyUp) {
  ASSERT_TRUE(line_.open(device_));
  EXPECT_EQ(line_.unsent(), 0u);
  line_.drain(1h);  // nothing to wait for
  stuck_bytes = 20;
  flushed = 0;
  EXPECT_EQ(line_.unsent(), 20u);
  line_.drain(20ms);
  EXPECT_EQ(flushed, 0);
  line_.close();
  EXPECT_EQ(flushed, 1) << "else close(2) waits for it";
  stuck_bytes = -1;
}

TEST_F(SerialLineTest, ADeviceThatIsNotThereIsNamed) {
  const auto opened = line_.open("/nonexistent/tty");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().message, "/nonexistent/tty: No such file or directory");
  EXPECT_FALSE(line_.open("/dev/null")) << "no serial line";
}

}  // namespace
}  // namespace hal::robot::platform
