#include "hal/rtps/walk.h"

#include <algorithm>

namespace hal::rtps {
namespace {

constexpr std::uint8_t kMajor = 2;
constexpr std::array kMagic{std::byte{'R'}, std::byte{'T'}, std::byte{'P'}, std::byte{'S'}};

/// Whether a length of 0 means an empty body; for all other kinds it means that the body extends to
/// the end of the datagram (9.4.5.1.3).
bool may_be_empty(SubmessageKind kind) {
  return kind == SubmessageKind::kPad || kind == SubmessageKind::kInfoTimestamp;
}

}  // namespace

Walk::Walk(Octets datagram) : datagram_(datagram) {
  Cursor cursor(datagram, Endianness::kBig);
  const Octets magic = cursor.take(kMagic.size());
  header_.major = cursor.u8();
  header_.minor = cursor.u8();
  std::ranges::copy(cursor.take(header_.vendor.size()), header_.vendor.begin());
  std::ranges::copy(cursor.take(header_.source.octets.size()), header_.source.octets.begin());
  if (cursor.is_short()) {
    fault_ = {0, "header", "it is shorter than 20 octets"};
  } else if (!std::ranges::equal(magic, kMagic)) {
    fault_ = {0, "header", "it does not begin with RTPS"};
  } else if (header_.major != kMajor) {
    fault_ = {4, "header", "its major version is not 2"};
  }
}

const Submessage* Walk::stop(std::size_t at, std::string_view what) {
  fault_ = {at, "submessage", what};
  return nullptr;
}

const Submessage* Walk::next() {
  if (fault_ || next_ == datagram_.size()) return nullptr;
  const std::size_t at = next_;
  if (datagram_.size() - at < 4) return stop(at, "its header is cut off");
  current_.at = at;
  current_.kind = static_cast<SubmessageKind>(datagram_[at]);
  current_.flags = std::to_integer<std::uint8_t>(datagram_[at + 1]);
  std::size_t length = Cursor(datagram_.subspan(at + 2), current_.endianness()).u16();
  const std::size_t left = datagram_.size() - at - 4;
  if (length == 0 && !may_be_empty(current_.kind)) length = left;
  if (length > left) return stop(at, "it is longer than the datagram");
  // Otherwise receivers differ in where they look for the next one (9.4.1: aligned to 4).
  if (length < left && length % 4 != 0) return stop(at, "the next one is not aligned to 4 octets");
  current_.body = datagram_.subspan(at + 4, length);
  next_ = at + 4 + length;
  return &current_;
}

}  // namespace hal::rtps
