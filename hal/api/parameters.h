#pragma once

#include <concepts>
#include <cstdint>
#include <map>
#include <set>
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

/// What a text parameter names, or each text of a list. Names that nobody has are found before a
/// run.
enum class Naming : std::uint8_t {
  kNothing,
  kAgent,       ///< An agent of the scenario.
  kOtherAgent,  ///< Likewise, and not the one that has the parameter.
  kSentTopic,   ///< A topic on which it sends.
  kHeardTopic,  ///< A topic that it hears.
};

class Parameters;

/// One parameter a controller understands, so that `baraka check` can judge a scenario without
/// running the controller. Its default says of what kind it is:
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
  std::string name{};
  std::string unit{};  ///< "s", "m", "m/s", "1" for a plain number, …; of numbers only.
  ParameterValue default_value = 0;    ///< In SI units. Infinity: "never" or "none" in a file.
  double low = 0, high = 0;            ///< Inclusive range of each number, SI.
  std::string meaning{};               ///< One line for people.
  std::vector<std::string> choices{};  ///< The texts that it may be. Empty: any.
  Naming names = Naming::kNothing;     ///< Of a text, or of each of a list.
  std::vector<std::string> besides{};  ///< Texts that name none, beside the default.
  /// Whether what it names matters, with the others as they are. Null: always.
  bool (*is_used)(const Parameters&) = nullptr;
};

/// The checked values of one agent's parameters, in SI units, defaults filled in.
class Parameters {
 public:
  using Values = std::map<std::string, ParameterValue, std::less<>>;

  Parameters() = default;
  /// @param given  names of those that are not left at their defaults.
  explicit Parameters(Values values, std::set<std::string, std::less<>> given = {})
      : values_(std::move(values)), given_(std::move(given)) {}

  // @pre the controller's kind declares a parameter of that name, with a default of that kind;
  //   aborts otherwise.
  double operator[](std::string_view name) const { return at(name).number(); }
  bool flag(std::string_view name) const { return at(name).flag(); }
  const std::string& text(std::string_view name) const { return at(name).text(); }
  const std::vector<double>& numbers(std::string_view name) const { return at(name).numbers(); }
  const std::vector<std::string>& texts(std::string_view name) const { return at(name).texts(); }

  /// Whether the scenario gives it, be it with the value of the default.
  bool is_given(std::string_view name) const { return given_.contains(name); }

 private:
  const ParameterValue& at(std::string_view name) const;
  Values values_;
  std::set<std::string, std::less<>> given_;
};

}  // namespace hal
