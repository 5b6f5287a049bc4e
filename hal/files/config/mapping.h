#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/files/config/key.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::files::config {

struct Node;
struct Entry;
struct Place;
class Problems;

/// Longest time that a file may state, s: about 31 years, well within Duration.
inline constexpr double kLongestDuration = 1e9;

/// A scalar as written in the file.
struct Scalar {
  std::string key;  ///< Empty in a list.
  std::string text;
  std::string place;  ///< "file:line:column".
};

/// The value of a key in a mapping whose keys are names: one scalar, or a list of scalars. Keys of
/// inner mappings are joined with dots: "temperature.size".
struct PlainValue {
  std::string key;
  std::string text;   ///< If it is a scalar.
  std::string place;  ///< "file:line:column".
  bool is_list = false;
  std::vector<std::string> items{};  ///< If it is a list.
};

/// A value of any kind, to be read elsewhere.
struct WrittenValue {
  std::string text;   ///< For messages: a scalar as written, other values as `yaml`.
  std::string yaml;   ///< On one line, as it may follow the `=` of an override.
  std::string place;  ///< "file:line:column".
};

/// The value of a key in a mapping whose keys are names, of any kind.
struct WrittenEntry {
  std::string key;
  WrittenValue value;
  bool is_list = false;
  std::vector<WrittenValue> items{};  ///< If it is a list.
};

/// One name of an enumeration.
template <class E>
struct Option {
  std::string_view name;
  E value;
};

/// One mapping of a document, read key by key. Every call marks its key as known. A mistake is
/// recorded with its place, and the call returns a harmless value, so that reading continues and
/// finds all mistakes. A call without `otherwise` requires the key; a call with it returns
/// `otherwise` also for a wrong value, so that one mistake does not cause others.
///
/// Each reading call takes a Key, which describes the key in the message if it is missing.
class Mapping {
 public:
  Mapping(const Node& node, std::string path, Problems& problems);

  /// A value with a unit (see value.h), in that unit.
  double number(const Key& key, std::string_view unit, Range range);
  double number(const Key& key, std::string_view unit, Range range, double otherwise);

  /// An integer without a unit.
  std::int64_t integer(const Key& key, std::int64_t low, std::int64_t high);
  std::int64_t integer(const Key& key, std::int64_t low, std::int64_t high, std::int64_t otherwise);

  /// A time, to the nanosecond; limits in seconds.
  Duration duration(const Key& key, Range seconds);
  Duration duration(const Key& key, Range seconds, Duration otherwise);
  /// The same without an upper limit: "none" and "never" give nullopt.
  std::optional<Duration> optional_duration(const Key& key, double low,
                                            std::optional<Duration> otherwise);

  /// true or false, nothing else.
  bool flag(const Key& key, bool otherwise);

  /// Text that is not empty.
  std::string text(const Key& key);
  std::string text(const Key& key, const std::string& otherwise);

  /// Two, or three, values of one unit: [1 m, 2 m].
  Vec2 vec2(const Key& key, std::string_view unit, Range range);
  Vec2 vec2(const Key& key, std::string_view unit, Range range, Vec2 otherwise);
  Vec3 vec3(const Key& key, std::string_view unit, Range range);

  /// A list of texts; absent: empty.
  std::vector<Scalar> texts(const Key& key);

  /// The index of one of several names.
  std::size_t choice(const Key& key, std::vector<std::string> names, std::size_t otherwise) {
    return chosen(key, std::move(names), otherwise).value_or(otherwise);
  }
  /// nullopt if the key is missing or has another value.
  std::optional<std::size_t> choice(const Key& key, std::vector<std::string> names) {
    return chosen(key, std::move(names), std::nullopt);
  }

  /// An inner mapping; absent: an empty one, all of whose required keys are missing.
  Mapping mapping(const Key& key);
  /// A list of mappings; absent: empty.
  std::vector<Mapping> mappings(const Key& key);

  /// The same for keys that were read before.
  Mapping within(const std::string& key);
  std::vector<Mapping> items(const std::string& key);

  /// Whether the key is present. It counts as known from now on.
  bool has(const std::string& key);

  /// Whether the key is present with a scalar, not a mapping or a list; for keys that may have
  /// either.
  bool has_scalar(const std::string& key);
  /// The same for a mapping.
  bool has_mapping(const std::string& key);

  /// All keys in order, for mappings whose keys are names.
  std::vector<std::string> keys() const;
  /// All entries, for mappings whose keys are names and whose values are scalars or lists of them.
  std::vector<PlainValue> plain_values();
  /// The same, where values may also be mappings of such values.
  std::vector<PlainValue> nested_values();

  /// The same for values of any kind.
  std::vector<WrittenEntry> written_values();

  /// "file:line:column" of a key's value, or of the mapping if the key is absent.
  std::string place(const std::string& key) const;
  std::string place() const;
  /// Dotted path of the mapping: "agents.motes"; empty for the top level.
  const std::string& path() const { return path_; }

  /// Records a mistake in a key's value; at the mapping's place if the key is absent.
  void mistake(const std::string& key, std::string what);
  /// Records something permitted but probably unintended. It is reported, but nothing is refused.
  void warn(const std::string& key, std::string what);
  /// Records that `key` is not used here, and why, if it is present.
  void refuse(const std::string& key, const std::string& why);

  /// After a mistake: finish() does not report unread keys.
  void leave_rest() { leaves_rest_ = true; }
  bool leaves_rest() const { return leaves_rest_; }

  /// Records every key that was not read.
  void finish();

 private:
  Mapping inner(const Node& node, const std::string& path);
  Mapping inner_of(const std::string& key);
  std::vector<Mapping> inner_list(const std::string& key);
  std::string path_of(const std::string& key) const;
  const Entry* find(const std::string& key);
  const Node* required(const Key& key, const Form& form);
  const std::string* scalar(const Node& node, const std::string& key, std::string_view expected);
  std::optional<PlainValue> plain_value(const Node& node, const std::string& key,
                                        std::string_view expected);
  void add_nested(const Node& mapping, const std::string& prefix, std::vector<PlainValue>& values);
  std::optional<double> parsed(const Node& node, const Key& key, const Form& form);
  std::optional<std::int64_t> whole(const Node& node, const Key& key, const Form& form);
  std::vector<double> vector(const Key& key, const Form& form, const Node* node);
  std::optional<std::size_t> chosen(const Key& key, std::vector<std::string> names,
                                    std::optional<std::size_t> otherwise);

  const Node* node_;
  std::string path_;
  Problems* problems_;
  std::set<std::string> known_;
  /// Known keys in the order of reading, without refused ones.
  std::vector<std::string> order_;
  bool leaves_rest_ = false;
  /// Replaces a value whose mistake was recorded: missing keys are not reported.
  bool broken_ = false;
};

}  // namespace hal::files::config
