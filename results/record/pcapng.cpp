#include "results/record/pcapng.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace results::record {
namespace {

constexpr std::size_t kBuffer = std::size_t{1} << 16U;

// Block types and option codes.
constexpr std::uint32_t kSectionHeader = 0x0a0d0d0a;
constexpr std::uint32_t kInterfaceDescription = 1;
constexpr std::uint32_t kEnhancedPacket = 6;
constexpr std::uint32_t kByteOrder = 0x1a2b3c4d;
constexpr std::uint16_t kLinkTypeRadiotap = 127;
constexpr std::uint16_t kUserApplication = 4;  ///< Option of a section header.
constexpr std::uint16_t kInterfaceName = 2;
constexpr std::uint16_t kTimeResolution = 9;
constexpr std::uint16_t kPacketFlags = 2;

/// Appends an integer in little-endian order on any machine.
template <class Integer>
void put(std::string& out, Integer value) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    out.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
}

void pad(std::string& out) { out.append((4 - out.size() % 4) % 4, '\0'); }

void put_option(std::string& out, std::uint16_t code, std::string_view value) {
  put(out, code);
  put(out, static_cast<std::uint16_t>(value.size()));
  out += value;
  pad(out);
}

void end_options(std::string& out) { put(out, std::uint32_t{0}); }

std::string block(std::uint32_t type, const std::string& body) {
  const auto length = static_cast<std::uint32_t>(body.size() + 12);
  std::string out;
  out.reserve(length);
  put(out, type);
  put(out, length);
  out += body;
  put(out, length);
  return out;
}

std::string section_header() {
  std::string body;
  put(body, kByteOrder);
  put(body, std::uint16_t{1});   // major version
  put(body, std::uint16_t{0});   // minor version
  put(body, ~std::uint64_t{0});  // length: unspecified
  put_option(body, kUserApplication, "baraka");
  end_options(body);
  return block(kSectionHeader, body);
}

std::string interface_description(std::string_view name) {
  std::string body;
  put(body, kLinkTypeRadiotap);
  put(body, std::uint16_t{0});  // reserved
  put(body, std::uint32_t{0});  // no limit on the packet length
  put_option(body, kInterfaceName, name);
  put_option(body, kTimeResolution, "\x09");  // 10^-9 s
  end_options(body);
  return block(kInterfaceDescription, body);
}

}  // namespace

PcapngFile::PcapngFile(std::filesystem::path file, std::string_view interface)
    : file_(std::move(file)) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(errno);
  append(section_header());
  append(interface_description(interface));
}

PcapngFile::~PcapngFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PcapngFile::add(hal::Time at, Direction direction, std::span<const std::uint8_t> packet) {
  const auto time = static_cast<std::uint64_t>(hal::to_ns(at));
  const auto size = static_cast<std::uint32_t>(packet.size());
  std::string body;
  body.reserve(packet.size() + 40);
  put(body, std::uint32_t{0});  // the interface
  put(body, static_cast<std::uint32_t>(time >> 32U));
  put(body, static_cast<std::uint32_t>(time));
  put(body, size);  // captured length
  put(body, size);  // original length
  body.append(reinterpret_cast<const char*>(packet.data()), packet.size());
  pad(body);
  if (direction != Direction::kUnknown) {
    std::string flags;
    put(flags, static_cast<std::uint32_t>(direction));
    put_option(body, kPacketFlags, flags);
    end_options(body);
  }
  append(block(kEnhancedPacket, body));
}

void PcapngFile::append(const std::string& block) {
  if (failed_) return;
  buffer_ += block;
  if (buffer_.size() >= kBuffer) flush();
}

void PcapngFile::flush() {
  std::size_t done = 0;
  while (!failed_ && done < buffer_.size()) {
    const ssize_t wrote = ::write(descriptor_, buffer_.data() + done, buffer_.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote < 0) fail(errno);
    done += static_cast<std::size_t>(wrote);
  }
  written_ += static_cast<std::int64_t>(done);
  buffer_.clear();
}

void PcapngFile::fail(int error) {
  failed_ = true;
  buffer_.clear();
  // A partly written block would make the file unreadable.
  if (descriptor_ >= 0 && ::ftruncate(descriptor_, written_) != 0) error = errno;
  throw std::runtime_error(
      fmt::format("{}: cannot be written: {}", file_.string(), std::strerror(error)));
}

}  // namespace results::record
