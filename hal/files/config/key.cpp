#include "hal/files/config/key.h"

#include <fmt/format.h>

#include <cmath>

#include "hal/files/config/value.h"

namespace hal::files::config {
namespace {

std::string a_number(std::string_view unit) {
  return unit == "1" ? "a plain number" : fmt::format("a number with its unit ({})", unit);
}

std::string plain_or_with_unit(double value, std::string_view unit) {
  return unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

std::string axes(std::size_t size) { return size == 2 ? "[x, y]" : "[x, y, z]"; }

}  // namespace

std::string expected(const Form& form) {
  switch (form.kind) {
    case Form::Kind::kNumber:
      return a_number(form.unit);
    case Form::Kind::kWhole:
      return "a whole number";
    case Form::Kind::kFlag:
      return "true or false";
    case Form::Kind::kText:
      return "text";
    case Form::Kind::kVector:
      return fmt::format("{}, each {}", axes(form.size), a_number(form.unit));
    case Form::Kind::kNumbers:
      return fmt::format("a list, each {}", a_number(form.unit));
    case Form::Kind::kTexts:
      return "a list of texts";
    case Form::Kind::kChoice:
      return fmt::format("one of {}", fmt::join(form.options, ", "));
    case Form::Kind::kMapping:
      return "a mapping";
    case Form::Kind::kMappings:
      break;
  }
  return "a list of mappings";
}

std::string limits(const Form& form) {
  if (form.kind == Form::Kind::kWhole) {
    if (form.low == form.high) return fmt::format("{}", form.low);
    return form.high == std::numeric_limits<std::int64_t>::max()
               ? fmt::format("{} or more", form.low)
               : fmt::format("{} .. {}", form.low, form.high);
  }
  const bool has_numbers = form.kind == Form::Kind::kNumber || form.kind == Form::Kind::kVector ||
                           form.kind == Form::Kind::kNumbers;
  if (!has_numbers) return "";
  const std::string low = plain_or_with_unit(form.range.low, form.unit);
  if (!std::isinf(form.range.high)) {
    return fmt::format("{} .. {}", low, plain_or_with_unit(form.range.high, form.unit));
  }
  return fmt::format("{} or more, or {}", low, form.unit == "s" ? "never" : "none");
}

std::string missing(const Key& key, const Form& form) {
  std::string what = "is missing: " + expected(form);
  if (const std::string range = limits(form); !range.empty()) what += ", " + range;
  const bool shows = form.kind == Form::Kind::kChoice || (form.low == form.high && form.low != 0);
  if (!key.example.empty() && !shows) what += fmt::format(", e.g. {}", key.example);
  return what;
}

}  // namespace hal::files::config
