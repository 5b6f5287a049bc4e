#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hal::files::config {

/// Inclusive limits in the requested unit. An infinite `high` admits "none" and "never".
struct Range {
  double low = 0;
  double high = 0;
};

inline constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Value of Key::otherwise for a required key.
inline constexpr std::string_view kMustBeGiven = "must be given";

/// The name and description of a key, given where the key is read. `baraka describe`, docs/keys.md
/// and messages about missing keys are made from it and from the reading call, which knows unit,
/// range and default.
///
///   in.number({"mass", "Of the whole robot.", "12 kg"}, "kg", {0.1, 100});
class Key {
 public:
  /// @param means  one-line description; ends with a full stop.
  /// @param such_as  example value as in a file; for a mapping or a list of mappings only if its
  ///   keys are free.
  /// @param absent  what applies when the key is absent, if the default passed to the reading call
  ///   does not show it.
  Key(std::string called, std::string_view means, std::string_view such_as = {},
      std::string_view absent = {})
      : name(std::move(called)), meaning(means), example(such_as), otherwise(absent) {}

  template <class Name>
  requires std::convertible_to<Name, std::string_view> Key(
      const Name& /*name*/) {  // to refuse it with an explanation
    static_assert(sizeof(Name) == 0,
                  "DESCRIBE THE KEY where it is read: {\"name\", \"What it means.\", \"example\"}; "
                  "for one that was read before: within(), items(), has()");
  }

  std::string name;
  std::string_view meaning, example, otherwise;
};

/// The form that a key's value must have.
struct Form {
  enum class Kind : std::uint8_t {
    kNumber,  ///< With `unit`; "1": without a unit.
    kWhole,
    kFlag,
    kText,
    kVector,   ///< `size` numbers.
    kNumbers,  ///< A list of numbers.
    kTexts,
    kChoice,  ///< One of `options`.
    kMapping,
    kMappings,
  };
  Kind kind = Kind::kText;
  std::string_view unit{};
  Range range{};
  std::int64_t low = 0, high = 0;  ///< kWhole.
  std::size_t size = 0;
  std::vector<std::string> options{};
};

/// "a number with its unit (m)", "one of long, short".
std::string expected(const Form& form);

/// "1 .. 65534", "0.001 m .. 10 m", "0 s or more, or never"; empty if there are none.
std::string limits(const Form& form);

/// Message for a required key that is missing: "is missing: [x, y, z], each a number with its unit
/// (m), 0.001 m .. 10 m, e.g. [4 m, 20 cm, 50 cm]".
std::string missing(const Key& key, const Form& form);

}  // namespace hal::files::config
