#include "programs/preload/dilation.h"

#include <algorithm>
#include <charconv>

namespace programs::preload {
namespace {

__extension__ using Wide = __int128;

constexpr Nanoseconds kSmallestFactor = 10'000'000;  // billionths
constexpr std::size_t kPlaces = 9;

Wide floor_of(Wide dividend, Wide divisor) {
  const Wide quotient = dividend / divisor;
  return dividend % divisor < 0 ? quotient - 1 : quotient;
}

Wide ceiling_of(Wide dividend, Wide divisor) { return -floor_of(-dividend, divisor); }

Nanoseconds narrow(Wide value) {
  constexpr Wide kLeast = std::numeric_limits<Nanoseconds>::min();
  constexpr Wide kMost = std::numeric_limits<Nanoseconds>::max();
  return static_cast<Nanoseconds>(std::clamp(value, kLeast, kMost));
}

std::optional<Nanoseconds> digits(std::string_view text) {
  Nanoseconds value = 0;
  if (text.empty() || text.size() > kPlaces || text[0] == '-') return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::optional<Dilation> Dilation::from_text(std::string_view text) {
  const std::size_t point = text.find('.');
  const auto whole = digits(text.substr(0, point));
  std::optional<Nanoseconds> billionths = 0;
  if (point != std::string_view::npos) {
    const std::string_view places = text.substr(point + 1);
    billionths = digits(places);
    for (std::size_t i = places.size(); billionths && i < kPlaces; ++i) *billionths *= 10;
  }
  if (!whole || !billionths) return std::nullopt;
  const Nanoseconds sum = *whole * kWhole + *billionths;
  if (sum < kSmallestFactor || sum > kWhole) return std::nullopt;
  return Dilation(sum);
}

Nanoseconds Dilation::to_program(Nanoseconds kernel, Nanoseconds origin) const {
  return narrow(origin + floor_of((Wide{kernel} - origin) * billionths_, kWhole));
}

Nanoseconds Dilation::to_kernel(Nanoseconds program, Nanoseconds origin) const {
  return narrow(origin + ceiling_of((Wide{program} - origin) * kWhole, billionths_));
}

}  // namespace programs::preload
