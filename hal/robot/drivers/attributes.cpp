#include "hal/robot/drivers/attributes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>
#include <system_error>

namespace hal::robot::drivers {
namespace {

namespace fs = std::filesystem;

struct Descriptor {
  explicit Descriptor(const fs::path& file) : number(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

}  // namespace

bool has_attribute(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored);
}

Result<double> read_attribute(const fs::path& file) {
  const Descriptor descriptor(file);
  std::array<char, 64> bytes{};
  const ssize_t size =
      descriptor.number < 0 ? -1 : ::read(descriptor.number, bytes.data(), bytes.size());
  if (size < 0) {
    return fail(Errc::kNotConnected, fmt::format("{}: {}", file.string(), std::strerror(errno)));
  }
  std::string_view text(bytes.data(), static_cast<std::size_t>(size));
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
    return fail(Errc::kProtocol, fmt::format("{}: '{}' is not a number", file.string(), text));
  }
  return value;
}

}  // namespace hal::robot::drivers
