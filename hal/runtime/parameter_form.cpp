#include "hal/runtime/parameter_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/suggest.h"
#include "hal/config/units.h"
#include "hal/config/value.h"

namespace hal::runtime {
namespace {

using exchange::ParameterText;
using Form = config::Form;

tl::unexpected<Error> wrong(std::string what) {
  return fail(Errc::kInvalidArgument, std::move(what));
}

/// Nothing, or why the number cannot be used: a time that no Duration holds, the controller would
/// compute with garbage.
/// @param value  in the unit of `spec`.
std::string beyond_time(const ParameterSpec& spec, double value, const std::string& text) {
  const config::Unit& unit = *config::find_unit(spec.unit);
  if (unit.dimension != config::Dimension::kTime || std::isinf(value)) return {};
  const double seconds = config::converted(value, unit, *config::find_unit("s"));
  if (std::abs(seconds) <= config::kLongestDuration) return {};
  if (value < 0) {
    return fmt::format("{} is below the limit of {} s", text, -config::kLongestDuration);
  }
  return fmt::format("{} is above the limit of {} s{}", text, config::kLongestDuration,
                     std::isinf(spec.high) ? "; 'never' and 'none' are without end" : "");
}

Result<double> parse_number(const ParameterSpec& spec, const std::string& text) {
  Result<double> value = config::parse_value(text, spec.unit, spec.low, spec.high);
  if (!value) return value;
  std::string beyond = beyond_time(spec, *value, text);
  if (!beyond.empty()) return wrong(std::move(beyond));
  return value;
}

Result<ParameterValue> parse_numbers(const ParameterSpec& spec,
                                     const std::vector<std::string>& items) {
  std::vector<double> values;
  values.reserve(items.size());
  for (const std::string& item : items) {
    const Result<double> value = parse_number(spec, item);
    if (!value) {
      return wrong(fmt::format("item {}: {}", values.size() + 1, value.error().message));
    }
    values.push_back(*value);
  }
  return ParameterValue(std::move(values));
}

/// Nothing, or why the parameter may not be this text.
std::string no_choice(const ParameterSpec& spec, const std::string& text) {
  if (spec.choices.empty() || std::ranges::count(spec.choices, text) > 0) return {};
  return fmt::format("'{}' is not one of {}{}", text, fmt::join(spec.choices, ", "),
                     config::suggestion(text, spec.choices));
}

Result<ParameterValue> parse_texts(const ParameterSpec& spec, const ParameterText& given) {
  for (std::size_t i = 0; i < given.items.size(); ++i) {
    const std::string mistake = no_choice(spec, given.items[i]);
    if (!mistake.empty()) return wrong(fmt::format("item {}: {}", i + 1, mistake));
  }
  return ParameterValue(given.items);
}

Result<ParameterValue> parse_scalar(const ParameterSpec& spec, const std::string& text) {
  if (spec.default_value.kind() == ParameterKind::kNumber) {
    const Result<double> value = parse_number(spec, text);
    if (!value) return tl::unexpected(value.error());
    return ParameterValue(*value);
  }
  if (spec.default_value.kind() == ParameterKind::kFlag) {
    if (text == "true" || text == "false") return ParameterValue(text == "true");
    return wrong(fmt::format("must be true or false, not '{}'", text));
  }
  std::string mistake = no_choice(spec, text);
  if (!mistake.empty()) return wrong(std::move(mistake));
  return ParameterValue(text);
}

bool is_list(ParameterKind kind) {
  return kind == ParameterKind::kNumbers || kind == ParameterKind::kTexts;
}

Form::Kind form_kind(const ParameterSpec& spec) {
  switch (spec.default_value.kind()) {
    case ParameterKind::kNumber:
      return Form::Kind::kNumber;
    case ParameterKind::kFlag:
      return Form::Kind::kFlag;
    case ParameterKind::kText:
      return spec.choices.empty() ? Form::Kind::kText : Form::Kind::kChoice;
    case ParameterKind::kNumbers:
      return Form::Kind::kNumbers;
    case ParameterKind::kTexts:
      break;
  }
  return Form::Kind::kTexts;
}

}  // namespace

config::Form form_of(const ParameterSpec& spec) {
  return {.kind = form_kind(spec),
          .unit = spec.unit,
          .range = {spec.low, spec.high},
          .options = spec.choices};
}

std::string written(const ParameterSpec& spec, const ParameterValue& value) {
  std::vector<std::string> items;
  switch (value.kind()) {
    case ParameterKind::kNumber:
      return config::format_value(value.number(), spec.unit);
    case ParameterKind::kFlag:
      return value.flag() ? "true" : "false";
    case ParameterKind::kText:
      return value.text();
    case ParameterKind::kNumbers:
      for (const double number : value.numbers()) {
        items.push_back(config::format_value(number, spec.unit));
      }
      break;
    case ParameterKind::kTexts:
      items = value.texts();
  }
  return fmt::format("[{}]", fmt::join(items, ", "));
}

Result<ParameterValue> parse_parameter(const ParameterSpec& spec, const ParameterText& given) {
  if (is_list(spec.default_value.kind()) != given.is_list) {
    const std::string seen =
        given.is_list ? fmt::format("a list of {}", given.items.size()) : "'" + given.value + "'";
    return wrong(fmt::format("must be {}, not {}", expected(form_of(spec)), seen));
  }
  if (!given.is_list) return parse_scalar(spec, given.value);
  return spec.default_value.kind() == ParameterKind::kNumbers ? parse_numbers(spec, given.items)
                                                              : parse_texts(spec, given);
}

}  // namespace hal::runtime
