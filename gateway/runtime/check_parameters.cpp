#include "gateway/runtime/check_parameters.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <utility>

#include "gateway/runtime/parameter_form.h"
#include "hal/files/config/suggest.h"
#include "hal/files/config/units.h"
#include "hal/types/check.h"

namespace gateway::runtime {
namespace {

using hal::node::exchange::ParameterText;

const hal::ParameterSpec* find(const hal::ControllerKind& kind, std::string_view name) {
  const auto found = std::ranges::find(kind.parameters, name, &hal::ParameterSpec::name);
  return found == kind.parameters.end() ? nullptr : &*found;
}

std::string unknown(const hal::ControllerKind& kind, const std::string& name) {
  std::vector<std::string> names;
  for (const hal::ParameterSpec& spec : kind.parameters) names.push_back(spec.name);
  return fmt::format("is not a parameter of {}{}", kind.name,
                     hal::files::config::suggestion(name, names));
}

std::string mistake_in(const hal::ControllerKind& kind, const ParameterText& text) {
  const hal::ParameterSpec* const spec = find(kind, text.name);
  if (spec == nullptr) return unknown(kind, text.name);
  const hal::ParameterKind kind_of_value = spec->default_value.kind();
  const bool has_numbers =
      kind_of_value == hal::ParameterKind::kNumber || kind_of_value == hal::ParameterKind::kNumbers;
  if (has_numbers && hal::files::config::find_unit(spec->unit) == nullptr) {
    return fmt::format("{} declares it in '{}', which is no unit (\"1\" is that of a plain number)",
                       kind.name, spec->unit);
  }
  const hal::Result<hal::ParameterValue> value = parse_parameter(*spec, text);
  return value ? std::string() : value.error().message;
}

}  // namespace

std::vector<std::string> check_parameters(const hal::ControllerKind& kind,
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

hal::Parameters read_parameters(const hal::ControllerKind& kind,
                                const std::vector<ParameterText>& given) {
  hal::Parameters::Values values;
  std::set<std::string, std::less<>> names;
  for (const hal::ParameterSpec& spec : kind.parameters)
    values.emplace(spec.name, spec.default_value);
  for (const ParameterText& text : given) {
    const hal::ParameterSpec* const spec = find(kind, text.name);
    BARAKA_CHECK(spec != nullptr);
    hal::Result<hal::ParameterValue> value = parse_parameter(*spec, text);
    BARAKA_CHECK(value.has_value());
    values.insert_or_assign(text.name, std::move(*value));
    names.insert(text.name);
  }
  return hal::Parameters(std::move(values), std::move(names));
}

}  // namespace gateway::runtime
