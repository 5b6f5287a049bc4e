#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hal {

enum class ParameterKind : std::uint8_t { kNumber, kFlag, kText, kNumbers, kTexts };

/// A number [SI], true or false, a text, or a list of numbers or of texts.
class ParameterValue {
 public:
  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>)
      ParameterValue(Number number) {  // NOLINT(google-explicit-constructor)
    if constexpr (std::same_as<Number, bool>) {
      value_ = number;
    } else {
      value_ = static_cast<double>(number);
    }
  }
  ParameterValue(const char* text) : value_(std::string(text)) {}             // NOLINT
  ParameterValue(std::string text) : value_(std::move(text)) {}               // NOLINT
  ParameterValue(std::vector<double> list) : value_(std::move(list)) {}       // NOLINT
  ParameterValue(std::vector<std::string> list) : value_(std::move(list)) {}  // NOLINT

  ParameterKind kind() const;

  // The value. @pre it is of that kind; aborts otherwise.
  double number() const;
  bool flag() const;
  const std::string& text() const;
  const std::vector<double>& numbers() const;
  const std::vector<std::string>& texts() const;

  bool operator==(const ParameterValue&) const = default;

 private:
  std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>> value_;
};

/// One parameter a controller understands, so that `baraka check` can judge a scenario without
/// running the controller. Its default says of what kind it is:
///
///   {"speed", "m/s", 0.5, 0, 2, "How fast."}
///   {.name = "patrols", .default_value = false, .meaning = "Whether it goes round when idle."}
///   {.name = "way", .unit = "m", .default_value = std::vector<double>{}, .low = -100, .high = 100,
///    .meaning = "x and y of one point after the other."}
///   {.name = "mode", .default_value = "near", .meaning = "Whom it serves.",
///    .choices = {"near", "needy"}}
struct ParameterSpec {
  std::string name{};
  std::string unit{};  ///< "s", "m", "m/s", "1" for a plain number, …; of numbers only.
  ParameterValue default_value = 0;    ///< In SI units. Infinity: "never" or "none" in a file.
  double low = 0, high = 0;            ///< Inclusive range of each number, SI.
  std::string meaning{};               ///< One line for people.
  std::vector<std::string> choices{};  ///< The texts that it may be. Empty: any.
};

/// The checked values of one agent's parameters, in SI units, defaults filled in.
class Parameters {
 public:
  using Values = std::map<std::string, ParameterValue, std::less<>>;

  Parameters() = default;
  explicit Parameters(Values values) : values_(std::move(values)) {}

  // @pre the controller's kind declares a parameter of that name, with a default of that kind;
  //   aborts otherwise.
  double operator[](std::string_view name) const { return at(name).number(); }
  bool flag(std::string_view name) const { return at(name).flag(); }
  const std::string& text(std::string_view name) const { return at(name).text(); }
  const std::vector<double>& numbers(std::string_view name) const { return at(name).numbers(); }
  const std::vector<std::string>& texts(std::string_view name) const { return at(name).texts(); }

 private:
  const ParameterValue& at(std::string_view name) const;
  Values values_;
};

}  // namespace hal
