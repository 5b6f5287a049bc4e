#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// A serial line of text: 57600 baud, 8 data bits, no parity, 1 stop bit, raw, for this process
/// alone. One thread.
class SerialLine {
 public:
  SerialLine() = default;
  ~SerialLine() { close(); }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Opens a device and forgets what came in before. Errors: kNotConnected.
  Result<void> open(const std::string& device);
  /// What is not sent yet is forgotten: the system would wait for a stuck line, up to 30 s.
  void close();

  /// Queues bytes for sending. Errors: kNotConnected (also: the line takes no more).
  Result<void> write(std::string_view text);

  /// Bytes that are queued and not sent yet.
  std::size_t unsent() const;
  /// Forgets those. The far end may have got a part of a line.
  void forget_unsent();

  /// The next line, without its end (LF or CR LF); nothing: none came within the time.
  /// Errors: kNotConnected (hung up), kProtocol (longer than any line should be).
  Result<std::optional<std::string>> read(Duration at_most);

  /// Waits until everything was sent, but no longer than so.
  void drain(Duration at_most) const;

 private:
  Result<bool> receive(Duration at_most);
  std::optional<std::string> take_line();

  int descriptor_ = -1;
  std::string received_;
};

}  // namespace hal::robot::platform
