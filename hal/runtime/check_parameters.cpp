#include "hal/runtime/check_parameters.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hal/config/mapping.h"
#include "hal/config/suggest.h"
#include "hal/config/units.h"
#include "hal/config/value.h"
#include "hal/types/check.h"

namespace hal::runtime {
namespace {

using exchange::ParameterText;

const ParameterSpec* find(const ControllerKind& kind, std::string_view name) {
  const auto found = std::ranges::find(kind.parameters, name, &ParameterSpec::name);
  return found == kind.parameters.end() ? nullptr : &*found;
}

Result<double> parse(const ParameterSpec& spec, const ParameterText& text) {
  return config::parse_value(text.value, spec.unit, spec.low, spec.high);
}

/// A time that no Duration holds: the controller would compute with garbage.
/// @param value  in the unit of `spec`.
bool is_beyond_time(const ParameterSpec& spec, double value) {
  const config::Unit& unit = *config::find_unit(spec.unit);
  if (unit.dimension != config::Dimension::kTime || std::isinf(value)) return false;
  const double seconds = config::converted(value, unit, *config::find_unit("s"));
  return std::abs(seconds) > config::kLongestDuration;
}

std::string unknown(const ControllerKind& kind, const std::string& name) {
  std::vector<std::string> names;
  for (const ParameterSpec& spec : kind.parameters) names.push_back(spec.name);
  return fmt::format("is not a parameter of {}{}", kind.name, config::suggestion(name, names));
}

std::string mistake_in(const ControllerKind& kind, const ParameterText& text) {
  const ParameterSpec* const spec = find(kind, text.name);
  if (spec == nullptr) return unknown(kind, text.name);
  if (config::find_unit(spec->unit) == nullptr) {
    return fmt::format("{} declares it in '{}', which is no unit (\"1\" is that of a plain number)",
                       kind.name, spec->unit);
  }
  const Result<double> value = parse(*spec, text);
  if (!value) return value.error().message;
  if (!is_beyond_time(*spec, *value)) return {};
  if (*value < 0) {
    return fmt::format("{} is below the limit of {} s", text.value, -config::kLongestDuration);
  }
  return fmt::format("{} is above the limit of {} s{}", text.value, config::kLongestDuration,
                     std::isinf(spec->high) ? "; 'never' and 'none' are without end" : "");
}

}  // namespace

std::vector<std::string> check_parameters(const ControllerKind& kind,
                                          const std::vector<ParameterText>& given) {
  std::vector<std::string> mistakes;
  const auto report = [&](const ParameterText& text, const std::string& mistake) {
    mistakes.push_back(fmt::format("{}: {}: {}", text.place, text.name, mistake));
  };
  for (auto text = given.begin(); text != given.end(); ++text) {
    const auto earlier =
        std::find_if(given.begin(), text, [&](const auto& e) { return e.name == text->name; });
    if (earlier != text) report(*text, "already given at " + earlier->place);
    const std::string mistake = mistake_in(kind, *text);
    if (!mistake.empty()) report(*text, mistake);
  }
  return mistakes;
}

Parameters read_parameters(const ControllerKind& kind, const std::vector<ParameterText>& given) {
  std::map<std::string, double, std::less<>> values;
  for (const ParameterSpec& spec : kind.parameters) values[spec.name] = spec.default_value;
  for (const ParameterText& text : given) {
    const ParameterSpec* const spec = find(kind, text.name);
    BARAKA_CHECK(spec != nullptr);
    const Result<double> value = parse(*spec, text);
    BARAKA_CHECK(value.has_value());
    values[text.name] = *value;
  }
  return Parameters(std::move(values));
}

}  // namespace hal::runtime
