#include "gateway/runtime/parameter_form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/config/suggest.h"
#include "hal/files/config/units.h"
#include "hal/files/config/value.h"

namespace gateway::runtime {
namespace {

using hal::node::exchange::ParameterText;
using Form = hal::files::config::Form;

tl::unexpected<hal::Error> wrong(std::string what) {
  return hal::fail(hal::Errc::kInvalidArgument, std::move(what));
}

/// Empty, or why the number cannot be used: if a time does not fit into a Duration, the controller
/// would compute with an undefined value.
/// @param value  in the unit of `spec`.
std::string beyond_time(const hal::ParameterSpec& spec, double value, const std::string& text) {
  const hal::files::config::Unit& unit = *hal::files::config::find_unit(spec.unit);
  if (unit.dimension != hal::files::config::Dimension::kTime || std::isinf(value)) return {};
  const double seconds =
      hal::files::config::converted(value, unit, *hal::files::config::find_unit("s"));
  if (std::abs(seconds) <= hal::files::config::kLongestDuration) return {};
  if (value < 0) {
    return fmt::format("{} is below the limit of {} s", text,
                       -hal::files::config::kLongestDuration);
  }
  return fmt::format("{} is above the limit of {} s{}", text, hal::files::config::kLongestDuration,
                     std::isinf(spec.high) ? "; 'never' and 'none' are without end" : "");
}

hal::Result<double> parse_number(const hal::ParameterSpec& spec, const std::string& text) {
  hal::Result<double> value = hal::files::config::parse_value(text, spec.unit, spec.low, spec.high);
  if (!value) return value;
  std::string beyond = beyond_time(spec, *value, text);
  if (!beyond.empty()) return wrong(std::move(beyond));
  return value;
}

hal::Result<hal::ParameterValue> parse_numbers(const hal::ParameterSpec& spec,
                                               const std::vector<std::string>& items) {
  std::vector<double> values;
  values.reserve(items.size());
  for (const std::string& item : items) {
    const hal::Result<double> value = parse_number(spec, item);
    if (!value) {
      return wrong(fmt::format("item {}: {}", values.size() + 1, value.error().message));
    }
    values.push_back(*value);
  }
  return hal::ParameterValue(std::move(values));
}

/// Empty, or why the parameter cannot have this text.
std::string no_choice(const hal::ParameterSpec& spec, const std::string& text) {
  if (spec.choices.empty() || std::ranges::count(spec.choices, text) > 0) return {};
  return fmt::format("'{}' is not one of {}{}", text, fmt::join(spec.choices, ", "),
                     hal::files::config::suggestion(text, spec.choices));
}

hal::Result<hal::ParameterValue> parse_texts(const hal::ParameterSpec& spec,
                                             const ParameterText& given) {
  for (std::size_t i = 0; i < given.items.size(); ++i) {
    const std::string mistake = no_choice(spec, given.items[i]);
    if (!mistake.empty()) return wrong(fmt::format("item {}: {}", i + 1, mistake));
  }
  return hal::ParameterValue(given.items);
}

hal::Result<hal::ParameterValue> parse_scalar(const hal::ParameterSpec& spec,
                                              const std::string& text) {
  if (spec.default_value.kind() == hal::ParameterKind::kNumber) {
    const hal::Result<double> value = parse_number(spec, text);
    if (!value) return tl::unexpected(value.error());
    return hal::ParameterValue(*value);
  }
  if (spec.default_value.kind() == hal::ParameterKind::kFlag) {
    if (text == "true" || text == "false") return hal::ParameterValue(text == "true");
    return wrong(fmt::format("must be true or false, not '{}'", text));
  }
  std::string mistake = no_choice(spec, text);
  if (!mistake.empty()) return wrong(std::move(mistake));
  return hal::ParameterValue(text);
}

bool is_list(hal::ParameterKind kind) {
  return kind == hal::ParameterKind::kNumbers || kind == hal::ParameterKind::kTexts;
}

Form::Kind form_kind(const hal::ParameterSpec& spec) {
  switch (spec.default_value.kind()) {
    case hal::ParameterKind::kNumber:
      return Form::Kind::kNumber;
    case hal::ParameterKind::kFlag:
      return Form::Kind::kFlag;
    case hal::ParameterKind::kText:
      return spec.choices.empty() ? Form::Kind::kText : Form::Kind::kChoice;
    case hal::ParameterKind::kNumbers:
      return Form::Kind::kNumbers;
    case hal::ParameterKind::kTexts:
      break;
  }
  return Form::Kind::kTexts;
}

}  // namespace

hal::files::config::Form form_of(const hal::ParameterSpec& spec) {
  return {.kind = form_kind(spec),
          .unit = spec.unit,
          .range = {spec.low, spec.high},
          .options = spec.choices};
}

std::string written(const hal::ParameterSpec& spec, const hal::ParameterValue& value) {
  std::vector<std::string> items;
  switch (value.kind()) {
    case hal::ParameterKind::kNumber:
      return hal::files::config::format_value(value.number(), spec.unit);
    case hal::ParameterKind::kFlag:
      return value.flag() ? "true" : "false";
    case hal::ParameterKind::kText:
      return value.text();
    case hal::ParameterKind::kNumbers:
      for (const double number : value.numbers()) {
        items.push_back(hal::files::config::format_value(number, spec.unit));
      }
      break;
    case hal::ParameterKind::kTexts:
      items = value.texts();
  }
  return fmt::format("[{}]", fmt::join(items, ", "));
}

hal::Result<hal::ParameterValue> parse_parameter(const hal::ParameterSpec& spec,
                                                 const ParameterText& given) {
  if (is_list(spec.default_value.kind()) != given.is_list) {
    const std::string seen =
        given.is_list ? fmt::format("a list of {}", given.items.size()) : "'" + given.value + "'";
    return wrong(fmt::format("must be {}, not {}", expected(form_of(spec)), seen));
  }
  if (!given.is_list) return parse_scalar(spec, given.value);
  return spec.default_value.kind() == hal::ParameterKind::kNumbers
             ? parse_numbers(spec, given.items)
             : parse_texts(spec, given);
}

}  // namespace gateway::runtime
