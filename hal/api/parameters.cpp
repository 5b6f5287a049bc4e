#include "hal/api/parameters.h"

#include "hal/types/check.h"

namespace hal {
namespace {

template <class T, class Variant>
const T& only(const Variant& value) {
  const T* const held = std::get_if<T>(&value);
  BARAKA_CHECK(held != nullptr);
  return *held;
}

struct KindOf {
  ParameterKind operator()(double) const { return ParameterKind::kNumber; }
  ParameterKind operator()(bool) const { return ParameterKind::kFlag; }
  ParameterKind operator()(const std::string&) const { return ParameterKind::kText; }
  ParameterKind operator()(const std::vector<double>&) const { return ParameterKind::kNumbers; }
  ParameterKind operator()(const std::vector<std::string>&) const { return ParameterKind::kTexts; }
};

}  // namespace

ParameterKind ParameterValue::kind() const { return std::visit(KindOf{}, value_); }

double ParameterValue::number() const { return only<double>(value_); }
bool ParameterValue::flag() const { return only<bool>(value_); }
const std::string& ParameterValue::text() const { return only<std::string>(value_); }
const std::vector<double>& ParameterValue::numbers() const {
  return only<std::vector<double>>(value_);
}
const std::vector<std::string>& ParameterValue::texts() const {
  return only<std::vector<std::string>>(value_);
}

const ParameterValue& Parameters::at(std::string_view name) const {
  const auto found = values_.find(name);
  BARAKA_CHECK(found != values_.end());
  return found->second;
}

}  // namespace hal
