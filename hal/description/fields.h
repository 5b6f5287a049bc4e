#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/config/mapping.h"
#include "hal/config/writer.h"
#include "hal/types/check.h"
#include "hal/types/quantity.h"
#include "hal/types/time.h"

namespace hal::description {

using config::Key;
using config::kUnlimited;
using config::Mapping;
using config::Option;
using config::Range;
using config::Writer;

constexpr Range kAngle{-10, 10};   ///< rad, more than a full turn either way.
constexpr Range kOffset{-10, 10};  ///< m, from a body's origin.

/// Reads the fields of a struct from a mapping; what is absent keeps its value. The struct's keys,
/// units and limits stand once, in a template over FieldReader and FieldWriter, so that what is
/// written can be read.
class FieldReader {
 public:
  explicit FieldReader(Mapping& in) : in_(in) {}

  void number(const Key& key, std::string_view unit, Range range, double& value) {
    value = in_.number(key, unit, range, value);
  }
  /// Must be there.
  void needed(const Key& key, std::string_view unit, Range range, double& value) {
    value = in_.number(key, unit, range);
  }
  /// A Quantity or a Dbm.
  template <class Q>
  void quantity(const Key& key, std::string_view unit, Range range, Q& value) {
    value = Q{in_.number(key, unit, range, value.value)};
  }
  /// "none" gives nothing.
  template <class Q>
  void optional(const Key& key, std::string_view unit, double low, std::optional<Q>& value) {
    const double absent = kUnlimited;
    const double given = in_.number(key, unit, {low, kUnlimited}, value ? value->value : absent);
    value = given == absent ? std::nullopt : std::optional<Q>{given};
  }
  template <class Integer>
  void count(const Key& key, std::int64_t low, std::int64_t high, Integer& value) {
    value = static_cast<Integer>(in_.integer(key, low, high, static_cast<std::int64_t>(value)));
  }
  void duration(const Key& key, Range seconds, Duration& value) {
    value = in_.duration(key, seconds, value);
  }
  void optional_duration(const Key& key, double low, std::optional<Duration>& value) {
    value = in_.optional_duration(key, low, value);
  }
  void flag(const Key& key, bool& value) { value = in_.flag(key, value); }
  template <class E, std::size_t kSize>
  void choice(const Key& key, const std::array<Option<E>, kSize>& options, E& value) {
    value = in_.choice(key, options, value);
  }
  /// A key that has no meaning here.
  void unused(const std::string& key, const std::string& why) { in_.refuse(key, why); }

 private:
  Mapping& in_;
};

/// Writes the same fields.
class FieldWriter {
 public:
  explicit FieldWriter(Writer& out) : out_(out) {}

  void number(const Key& key, std::string_view unit, Range, double value) {
    out_.number(key.name, value, unit);
  }
  void needed(const Key& key, std::string_view unit, Range, double value) {
    out_.number(key.name, value, unit);
  }
  template <class Q>
  void quantity(const Key& key, std::string_view unit, Range, const Q& value) {
    out_.number(key.name, value.value, unit);
  }
  template <class Q>
  void optional(const Key& key, std::string_view unit, double, const std::optional<Q>& value) {
    out_.number(key.name, value ? value->value : kUnlimited, unit);
  }
  template <class Integer>
  void count(const Key& key, std::int64_t, std::int64_t, Integer value) {
    out_.integer(key.name, static_cast<std::int64_t>(value));
  }
  void duration(const Key& key, Range, Duration value) { out_.duration(key.name, value); }
  void optional_duration(const Key& key, double, const std::optional<Duration>& value) {
    if (value) {
      out_.duration(key.name, *value);
    } else {
      out_.text(key.name, "none");
    }
  }
  void flag(const Key& key, bool value) { out_.flag(key.name, value); }
  template <class E, std::size_t kSize>
  void choice(const Key& key, const std::array<Option<E>, kSize>& options, E value) {
    const auto found = std::ranges::find(options, value, &Option<E>::value);
    BARAKA_CHECK(found != options.end());  // what a file cannot say cannot be written to one
    out_.text(key.name, found->name);
  }
  void unused(const std::string&, const std::string&) {}

 private:
  Writer& out_;
};

}  // namespace hal::description
