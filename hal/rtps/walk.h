#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hal/rtps/cursor.h"
#include "hal/rtps/fault.h"
#include "hal/rtps/submessage.h"

namespace hal::rtps {

/// The first 20 octets of every datagram (OMG DDSI-RTPS 2.5, 9.4.4).
struct Header {
  static constexpr std::size_t kSize = 20;
  std::uint8_t major = 0, minor = 0;
  std::array<std::byte, 2> vendor{};
  GuidPrefix source;  ///< The participant that sent it.
};

/// Iterates over the submessages of one datagram, in order. Their contents are not checked;
/// validate() does that.
///
///   Walk walk(datagram);
///   while (const Submessage* one = walk.next()) count(*one);
///   if (walk.fault()) …
class Walk {
 public:
  /// @param datagram  must outlive this object and the results of next().
  explicit Walk(Octets datagram);

  const Header& header() const { return header_; }
  /// Null at the end, or where the datagram is malformed.
  const Submessage* next();
  const std::optional<Fault>& fault() const { return fault_; }

 private:
  const Submessage* stop(std::size_t at, std::string_view what);

  Octets datagram_;
  Header header_;
  std::size_t next_ = Header::kSize;
  Submessage current_;
  std::optional<Fault> fault_;
};

}  // namespace hal::rtps
