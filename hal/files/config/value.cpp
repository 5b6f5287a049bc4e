#include "hal/files/config/value.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <system_error>

#include "hal/files/config/units.h"
#include "hal/files/config/writer.h"
#include "hal/types/check.h"
#include "hal/types/time.h"

namespace hal::files::config {
namespace {

tl::unexpected<Error> wrong(std::string what) {
  return fail(Errc::kInvalidArgument, std::move(what));
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number and what follows it.
struct Parts {
  double number = 0;
  std::string_view unit;
};

/// A number starts with a decimal digit: std::from_chars would also accept "nan", "inf" and
/// hexadecimal digits.
std::optional<Parts> split(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const std::size_t first = text.starts_with('.') ? 1 : 0;
  if (text.size() <= first || !is_digit(text[first])) return std::nullopt;
  Parts parts;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parts.number);
  if (error != std::errc{}) return std::nullopt;
  if (negative) parts.number = -parts.number;
  parts.unit = trimmed(text.substr(static_cast<std::size_t>(end - text.data())));
  return parts;
}

/// The number in units of `wanted`, or why it cannot be one.
Result<double> in_unit(std::string_view text, const Parts& parts, const Unit& wanted) {
  if (wanted.dimension == Dimension::kNumber) {
    if (parts.unit.empty()) return parts.number;
    if (parts.unit == "%") return converted(parts.number, *find_unit("%"), wanted);
    return wrong(fmt::format("'{}' must be a plain number, without a unit", text));
  }
  const Unit* given = find_unit(parts.unit);
  if (given == nullptr || given->dimension != wanted.dimension) {
    // Users usually state angles in degrees.
    const bool angle = wanted.dimension == Dimension::kAngle;
    return wrong(fmt::format("'{}' must be written in {}{}, e.g. '{} {}'", text, wanted.name,
                             angle ? " or deg" : "", parts.number, angle ? "deg" : wanted.name));
  }
  return converted(parts.number, *given, wanted);
}

std::string with_unit(double value, std::string_view unit) {
  return unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

bool means_infinity(std::string_view text) { return text == "never" || text == "none"; }

}  // namespace

Result<double> parse_value(std::string_view text, std::string_view unit, double low, double high) {
  const Unit* wanted = find_unit(unit);
  BARAKA_CHECK(wanted != nullptr);
  text = trimmed(text);
  if (means_infinity(text) && std::isinf(high)) return std::numeric_limits<double>::infinity();
  const auto parts = split(text);
  if (!parts) return wrong(fmt::format("'{}' is not a number", text));
  auto value = in_unit(text, *parts, *wanted);
  if (!value) return value;
  // NaN would pass both comparisons below.
  if (!std::isfinite(*value)) return wrong(fmt::format("'{}' is not a finite number", text));
  if (*value < low) {
    return wrong(fmt::format("{} is below the limit of {}", text, with_unit(low, unit)));
  }
  if (*value > high) {
    return wrong(fmt::format("{} is above the limit of {}", text, with_unit(high, unit)));
  }
  return value;
}

std::string format_value(double value, std::string_view unit) {
  if (std::isinf(value)) return unit == "s" ? "never" : "none";
  return with_unit(value, unit);
}

std::string readable(double value, std::string_view unit) {
  std::string exact = format_value(value, unit);
  if (std::isinf(value)) return exact;
  if (unit == "s") return format_duration(from_seconds(value));
  if (unit != "rad") return exact;
  std::string degrees = format_value(converted(value, *find_unit("rad"), *find_unit("deg")), "deg");
  return degrees.size() < exact.size() ? degrees : exact;
}

std::optional<WrittenNumber> written_number(std::string_view text) {
  const auto parts = split(trimmed(text));
  if (!parts || !std::isfinite(parts->number)) return std::nullopt;
  if (parts->unit.empty()) return WrittenNumber{parts->number, "1"};
  if (find_unit(parts->unit) == nullptr || parts->unit == "1") return std::nullopt;
  return WrittenNumber{parts->number, std::string(parts->unit)};
}

std::string_view base_unit(std::string_view unit) {
  const Unit* const given = find_unit(unit);
  BARAKA_CHECK(given != nullptr);
  return base_unit_of(*given).name;
}

bool is_unit(std::string_view unit) { return find_unit(unit) != nullptr; }

}  // namespace hal::files::config
