#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal/types/result.h"
#include "hal/types/time.h"

namespace hal::robot::platform {

/// A serial line for text: 57600 baud, 8 data bits, no parity, 1 stop bit, raw, exclusive to this
/// process. One thread.
class SerialLine {
 public:
  SerialLine() = default;
  ~SerialLine() { close(); }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Opens a device and discards earlier input. Errors: kNotConnected.
  Result<void> open(const std::string& device);
  /// Closes the device and discards unsent bytes: the system would wait for a stuck line, up to 30
  /// s.
  void close();

  /// Queues bytes for transmission. Errors: kNotConnected (also if the queue is full).
  Result<void> write(std::string_view text);

  /// Number of queued bytes that have not been sent.
  std::size_t unsent() const;
  /// Discards them. The receiver may have got a part of a line.
  void forget_unsent();

  /// The next line, without its end (LF or CR LF); nullopt: none arrived in time.
  /// Errors: kNotConnected (hung up), kProtocol (longer than any line should be).
  Result<std::optional<std::string>> read(Duration at_most);

  /// Waits until everything was sent, but at most that long.
  void drain(Duration at_most) const;

 private:
  Result<bool> receive(Duration at_most);
  std::optional<std::string> take_line();

  int descriptor_ = -1;
  std::string received_;
};

}  // namespace hal::robot::platform
