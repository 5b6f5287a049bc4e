#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hal {

/// Kind of a parameter, determined by its default.
enum class ParameterKind : std::uint8_t { kNumber, kFlag, kText, kNumbers, kTexts };

/// Value of a parameter: a number [SI], a flag, a text, or a list of numbers or of texts.
class ParameterValue {
 public:
  /// A number [SI]; a bool becomes a flag.
  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>)
      ParameterValue(Number number) {  // NOLINT(google-explicit-constructor)
    if constexpr (std::same_as<Number, bool>) {
      value_ = number;
    } else {
      value_ = static_cast<double>(number);
    }
  }
  /// A text.
  ParameterValue(const char* text) : value_(std::string(text)) {}  // NOLINT
  /// A text.
  ParameterValue(std::string text) : value_(std::move(text)) {}  // NOLINT
  /// A list of numbers [SI].
  ParameterValue(std::vector<double> list) : value_(std::move(list)) {}  // NOLINT
  /// A list of texts.
  ParameterValue(std::vector<std::string> list) : value_(std::move(list)) {}  // NOLINT

  ParameterKind kind() const;  ///< Which of the five functions below is valid.

  double number() const;                          ///< SI. @pre it is a number; aborts otherwise.
  bool flag() const;                              ///< @pre it is a flag; aborts otherwise.
  const std::string& text() const;                ///< @pre it is a text; aborts otherwise.
  const std::vector<double>& numbers() const;     ///< SI. @pre it is such a list; aborts otherwise.
  const std::vector<std::string>& texts() const;  ///< @pre it is such a list; aborts otherwise.

  /// Same kind and equal value.
  bool operator==(const ParameterValue&) const = default;

 private:
  std::variant<double, bool, std::string, std::vector<double>, std::vector<std::string>> value_;
};

/// What a text parameter, or each text of a list, names. Unknown names are reported before a run.
enum class Naming : std::uint8_t {
  kNothing,
  kAgent,       ///< An agent of the scenario.
  kOtherAgent,  ///< An agent other than the one that has the parameter.
  kSentTopic,   ///< A topic on which the controller sends.
  kHeardTopic,  ///< A topic that the controller receives.
};

class Parameters;

/// A parameter of a controller, by which `baraka check` checks a scenario without running the
/// controller. The default determines its kind:
///
///   {"speed", "m/s", 0.5, 0, 2, "How fast."}
///   {.name = "patrols", .default_value = false, .meaning = "Whether it goes round when idle."}
///   {.name = "way", .unit = "m", .default_value = std::vector<double>{}, .low = -100, .high = 100,
///    .meaning = "x and y of one point after the other."}
///   {.name = "mode", .default_value = "near", .meaning = "Whom it serves.",
///    .choices = {"near", "needy"}}
///   {.name = "to", .default_value = "everyone", .meaning = "Name of an agent, or `everyone`.",
///    .names = hal::Naming::kAgent}
struct ParameterSpec {
  std::string name{};  ///< As in `parameters:` of a scenario.
  /// "s", "m", "m/s", "1" for a plain number, …; for numbers only.
  std::string unit{};
  ParameterValue default_value = 0;    ///< In SI units. Infinity: "never" or "none" in a file.
  double low = 0;                      ///< Least value of each number, SI.
  double high = 0;                     ///< Largest value of each number, SI.
  std::string meaning{};               ///< One-line description.
  std::vector<std::string> choices{};  ///< Permitted texts. Empty: any.
  Naming names = Naming::kNothing;     ///< What a text, or each text of a list, names.
  /// Permitted texts that are not names, in addition to the default.
  std::vector<std::string> besides{};
  /// Whether the name is used, given the other parameters. Null: always.
  std::function<bool(const Parameters&)> is_used = nullptr;
};

/// The checked parameters of one agent, in SI units, including defaults.
class Parameters {
 public:
  /// Values by parameter name.
  using Values = std::map<std::string, ParameterValue, std::less<>>;

  Parameters() = default;
  /// @param values  one for each parameter of the controller's kind, in SI units.
  /// @param given  names of those that the scenario sets.
  explicit Parameters(Values values, std::set<std::string, std::less<>> given = {})
      : values_(std::move(values)), given_(std::move(given)) {}

  /// The number with this name, SI. @pre for this and the next four functions: the controller
  /// declares a parameter with this name and kind; aborts otherwise.
  double operator[](std::string_view name) const { return at(name).number(); }
  /// The flag of that name.
  bool flag(std::string_view name) const { return at(name).flag(); }
  /// The text of that name.
  const std::string& text(std::string_view name) const { return at(name).text(); }
  /// The numbers of that name, SI.
  const std::vector<double>& numbers(std::string_view name) const { return at(name).numbers(); }
  /// The texts of that name.
  const std::vector<std::string>& texts(std::string_view name) const { return at(name).texts(); }

  /// Whether the scenario sets it, even to the default.
  bool is_given(std::string_view name) const { return given_.contains(name); }

 private:
  const ParameterValue& at(std::string_view name) const;
  Values values_;
  std::set<std::string, std::less<>> given_;
};

}  // namespace hal
