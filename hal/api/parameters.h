#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hal {

/// One parameter a controller understands, so that `baraka check` can judge a scenario without
/// running the controller.
struct ParameterSpec {
  std::string name{};
  std::string unit{};        ///< "s", "m", "m/s", "1" for a plain number, …
  double default_value = 0;  ///< In SI units. Infinity is written "never" or "none" in a file.
  double low = 0, high = 0;  ///< Inclusive range, SI.
  std::string meaning{};     ///< One line for people.
};

/// The checked values of one agent's parameters, in SI units, defaults filled in.
class Parameters {
 public:
  Parameters() = default;
  explicit Parameters(std::map<std::string, double, std::less<>> values)
      : values_(std::move(values)) {}

  /// @pre the controller's kind declares a parameter of that name; aborts otherwise.
  double operator[](std::string_view name) const;

 private:
  std::map<std::string, double, std::less<>> values_;
};

}  // namespace hal
