#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "hal/files/config/mapping.h"
#include "hal/files/config/writer.h"
#include "hal/types/check.h"
#include "hal/types/geometry.h"
#include "hal/types/time.h"

namespace hal::files::description {

using config::Form;
using config::Key;
using config::kUnlimited;
using config::Mapping;
using config::Option;
using config::Range;
using config::Writer;

constexpr Range kAngle{-10, 10};   ///< rad, more than a full turn in either direction.
constexpr Range kOffset{-10, 10};  ///< m, from the body's origin.

/// The keys of a struct, each described once, by the call that binds its member: name and meaning
/// (Key), unit and limits or options. A function over Fields describes a struct: FieldReader reads
/// it from a file, FieldWriter writes it so that it reads back to the same bits, FieldNames lists
/// its keys, and KeyDescriber documents them.
///
///   void keys_of(Fields& io, Sonar& c) {
///     io.needed({"max_range", "What is farther is not seen.", "4 m"}, "m", {0, 9}, c.max_range);
///     io.duration({"period", "Between two measurements.", "60 ms"}, {0, 10}, c.period);
///   }
///
/// An absent key leaves its member unchanged, unless the key is `needed`.
class Fields {
 public:
  /// Function that describes the keys of a T.
  template <class T>
  using BodyOf = std::type_identity_t<std::function<void(Fields&, T&)>>;

  virtual ~Fields() = default;

  void number(const Key& key, std::string_view unit, Range range, double& value) {
    field({key, unit, range, &value});
  }
  void vec2(const Key& key, std::string_view unit, Range range, Vec2& value) {
    field({key, unit, range, &value});
  }
  void vec3(const Key& key, std::string_view unit, Range range, Vec3& value) {
    field({key, unit, range, &value});
  }
  /// A required double, Vec2 or Vec3.
  template <class T>
  void needed(const Key& key, std::string_view unit, Range range, T& value) {
    field({key, unit, range, &value, Presence::kNeeded});
  }
  /// A Quantity or a Dbm.
  template <class Q>
  void quantity(const Key& key, std::string_view unit, Range range, Q& value) {
    number(key, unit, range, value.value);
  }
  /// "none" gives nullopt.
  template <class Q>
  void optional(const Key& key, std::string_view unit, double low, std::optional<Q>& value) {
    double given = value ? value->value : kUnlimited;
    number(key, unit, {low, kUnlimited}, given);
    value = given == kUnlimited ? std::nullopt : std::optional<Q>{given};
  }
  template <class Integer>
  void count(const Key& key, std::int64_t low, std::int64_t high, Integer& value) {
    whole(key, low, high, value, Presence::kOtherwise);
  }
  template <class Integer>
  void needed_count(const Key& key, std::int64_t low, std::int64_t high, Integer& value) {
    whole(key, low, high, value, Presence::kNeeded);
  }
  void duration(const Key& key, Range seconds, Duration& value) {
    field({key, "s", seconds, &value});
  }
  void needed(const Key& key, Range seconds, Duration& value) {
    field({key, "s", seconds, &value, Presence::kNeeded});
  }
  /// "none" gives nullopt.
  void optional_duration(const Key& key, double low, std::optional<Duration>& value) {
    field({key, "s", {low, kUnlimited}, &value});
  }
  void flag(const Key& key, bool& value) { field({key, "", {}, &value}); }
  /// Text that is not empty.
  void text(const Key& key, std::string& value) { field({key, "", {}, &value}); }
  void needed_text(const Key& key, std::string& value) {
    field({key, "", {}, &value, Presence::kNeeded});
  }
  /// A list of texts.
  void texts(const Key& key, std::vector<std::string>& values) { field({key, "", {}, &values}); }
  /// @tparam Options  a range of Option<E>, or of anything with its members.
  template <class Options, class E>
  void choice(const Key& key, const Options& options, E& value) {
    one_of_options(key, options, value, Presence::kOtherwise);
  }
  /// A required choice.
  template <class Options, class E>
  void needed_choice(const Key& key, const Options& options, E& value) {
    one_of_options(key, options, value, Presence::kNeeded);
  }

  /// A member that has a value only if the key is present: a Quantity, a double, a Vec2, a
  /// Duration, an integer or an option. Without the key it is unchanged, and nullopt is not
  /// written. Each returns whether a value was read.
  template <class T>
  bool given(const Key& key, std::string_view unit, Range range, std::optional<T>& value) {
    T given = value.value_or(T{});
    auto& number = number_of(given);
    if constexpr (std::is_same_v<decltype(number), double&>) {
      if (!value) number = range.low;
    }
    const bool is_read = field_given({key, unit, range, &number}, value.has_value());
    if (is_read) value = given;
    return is_read;
  }
  bool given(const Key& key, Range seconds, std::optional<Duration>& value) {
    return given(key, "s", seconds, value);
  }
  template <class Integer>
  bool given_count(const Key& key, std::int64_t low, std::int64_t high,
                   std::optional<Integer>& value) {
    auto given = value ? static_cast<std::int64_t>(*value) : low;
    const bool is_read = field_given({key, "", {}, Whole{low, high, &given}}, value.has_value());
    if (is_read) value = static_cast<Integer>(given);
    return is_read;
  }
  template <class Options, class E>
  bool given_choice(const Key& key, const Options& options, std::optional<E>& value) {
    const auto found = find(options, value);
    BARAKA_CHECK(!value || found != options.end());
    auto index = found == options.end() ? 0 : static_cast<std::size_t>(found - options.begin());
    const bool is_read =
        field_given({key, "", {}, Choice{names(options), &index}}, value.has_value());
    if (is_read) value = options[index].value;
    return is_read;
  }
  /// Text; empty: the key is absent.
  bool given_text(const Key& key, std::string& value) {
    return field_given({key, "", {}, &value}, !value.empty());
  }

  /// A value with its own text form in files, which `spell` produces. `parse` takes a text that
  /// differs from it and records what is wrong with it.
  template <class T, class Spell, class Parse>
  void spelled(const Key& key, T& value, Spell&& spell, Parse&& parse) {
    const std::string before = spell(std::as_const(value));
    std::string text = before;
    this->text(key, text);
    if (reading() != nullptr && text != before) parse(text, value);
  }

  /// An inner mapping, whose keys `body` describes.
  virtual void inside(const Key& key, const std::function<void(Fields&)>& body) = 0;

  /// An optional mapping. Returns whether it is present.
  bool inside_given(const Key& key, bool is_there, const std::function<void(Fields&)>& body) {
    if (reading() != nullptr) is_there = reading()->has(key.name);
    if (is_describing()) {
      inside_if_there(key, body);
    } else if (is_there) {
      inside(key, body);
    }
    return is_there;
  }

  /// Mappings under names chosen by the user.
  /// @param each  description of one of them, with a placeholder as its name.
  /// @param names  those to write.
  virtual void named(const Key& each, const std::vector<std::string>& names,
                     const std::function<void(Fields&, const std::string&)>& body) = 0;

  /// A list of mappings, whose keys `body` describes. Items of unknown kinds are omitted. Items
  /// that are read replace the previous ones.
  /// @param like  initial value of an item before it is read.
  template <class T>
  void list(const Key& key, std::vector<T>& items, const BodyOf<T>& body, const T& like = {}) {
    bool is_first = true;
    each(key, items.size(), [&](Fields& io, std::size_t index) {
      if (io.reading() != nullptr && std::exchange(is_first, false)) items.clear();
      if (index >= items.size()) {
        index = items.size();
        items.push_back(like);
      }
      body(io, items[index]);
      if (io.reading() != nullptr && io.reading()->leaves_rest()) items.pop_back();
    });
  }
  /// The same; an empty list is not written.
  template <class T>
  void list_if_any(const Key& key, std::vector<T>& items, const BodyOf<T>& body,
                   const T& like = {}) {
    written_if(!items.empty(), [&](Fields& io) { io.list<T>(key, items, body, like); });
  }

  /// Keys that are always read, but written only on this condition.
  void written_if(bool is_written, const std::function<void(Fields&)>& body) {
    only(reading() != nullptr || is_written, {}, "", body);
  }

  /// One of several mappings, whose key selects the alternative of a variant. Without any of them
  /// the variant is unchanged and the keys of `otherwise` apply. `body` describes the alternative.
  /// Returns whether there is one.
  template <class V>
  struct Alternative {
    Key key;
    V (*make)();
  };
  template <class V, std::size_t kSize>
  bool one_of(
      const std::array<Alternative<V>, kSize>& alternatives, V& value, const BodyOf<V>& body,
      const std::function<void(Fields&)>& otherwise = [](Fields&) {}) {
    if (is_describing()) return describe_from<V>(alternatives, body, otherwise);
    const auto found = std::ranges::find_if(alternatives, [&](const Alternative<V>& one) {
      return reading() != nullptr ? reading()->has(one.key.name)
                                  : one.make().index() == value.index();
    });
    if (found == alternatives.end()) {
      otherwise(*this);
      return false;
    }
    if (reading() != nullptr) value = found->make();
    inside(found->key, [&](Fields& io) { body(io, value); });
    for (const Alternative<V>& other : alternatives) {
      if (&other != &*found) unused(other.key.name, "cannot be combined with " + found->key.name);
    }
    return true;
  }

  /// Keys that are valid only if another key has one of certain values, or is present ("there") or
  /// absent ("absent"); `applies` says whether this holds. Otherwise they are refused for the given
  /// reason, and not written.
  struct When {
    std::string key;
    std::vector<std::string> values;
  };
  virtual void only(bool applies, const When& when, const std::string& why,
                    const std::function<void(Fields&)>& body) = 0;

  /// One of several forms of a mapping, identified by a key. `is_it`: this is the form to write.
  struct Saying {
    std::string key;
    bool is_it;
    std::function<void(Fields&)> body;
  };
  /// Selects the first form whose key is present; the keys of the other forms are then unknown.
  /// @return false: no form is present.
  virtual bool first_of(const std::vector<Saying>& sayings) = 0;

  /// The kinds of a variant by their names under `key`, which is required; `body` describes the
  /// alternative. An unknown name is one mistake: other keys are then not checked.
  template <class V>
  struct Kind {
    std::string_view name;
    V (*make)();
  };
  template <class V, std::size_t kSize>
  void kinds(const Key& key, const std::array<Kind<V>, kSize>& all, V& value,
             const BodyOf<V>& body) {
    std::vector<std::string> names;
    names.reserve(kSize);
    std::optional<std::size_t> index;
    for (const Kind<V>& one : all) {
      if (reading() == nullptr && one.make().index() == value.index()) index = names.size();
      names.emplace_back(one.name);
    }
    const std::optional<V> before = is_describing() ? std::optional(value) : std::nullopt;
    kind_field(key, std::move(names), index, Presence::kNeeded, [&](Fields& io, std::size_t kind) {
      if (!is_writing()) value = all[kind].make();
      body(io, value);
    });
    if (before) value = *before;
  }

  /// A choice on which other keys depend: `body` describes them for each of its values. Without the
  /// key it is unchanged.
  template <class Options, class E>
  void choice(const Key& key, const Options& options, E& value,
              const std::function<void(Fields&)>& body) {
    const std::size_t index = index_in(options, value);
    kind_field(key, names(options), index, Presence::kOtherwise, [&](Fields& io, std::size_t kind) {
      value = options[kind].value;
      body(io);
    });
    if (is_describing()) value = options[index].value;
  }
  /// A kind by its index in `names`, required; `body` describes its keys. An unknown name is one
  /// mistake, as above.
  void kind(const Key& key, std::vector<std::string> names,
            const std::function<void(Fields&, std::size_t)>& body) {
    kind_field(key, std::move(names), std::nullopt, Presence::kNeeded, body);
  }

  /// A key whose value has its own form in files.
  /// @param form  default: a list of texts.
  void own(const Key& key, const std::function<void(Mapping&)>& read,
           const std::function<void(Writer&)>& write) {
    own(key, {.kind = Form::Kind::kTexts}, read, write);
  }
  virtual void own(const Key& key, const Form& form, const std::function<void(Mapping&)>& read,
                   const std::function<void(Writer&)>& write) = 0;

  /// A key that has no meaning here.
  virtual void unused(const std::string& key, const std::string& why) = 0;

  /// The mapping being read, for properties that only a file has; null while nothing is read.
  virtual Mapping* reading() { return nullptr; }

  /// Whether values are written, for keys that are written differently from how they are read.
  virtual bool is_writing() const { return false; }

  /// Records a mistake in what was read.
  void mistake(const std::string& key, std::string what) {
    if (Mapping* in = reading(); in != nullptr && !in->leaves_rest())
      in->mistake(key, std::move(what));
  }

 protected:
  enum class Presence : std::uint8_t {
    kOtherwise,  ///< If absent, the member is unchanged.
    kNeeded,
    kGiven,  ///< `is_there` says whether the key is present.
  };
  struct Whole {
    std::int64_t low, high;
    std::int64_t* value;
  };
  struct Choice {
    std::vector<std::string> names;
    std::size_t* value;
  };
  struct Field {
    const Key& key;
    std::string_view unit;
    Range range;
    std::variant<double*, Vec2*, Vec3*, Whole, Duration*, std::optional<Duration>*, bool*,
                 std::string*, std::vector<std::string>*, Choice>
        value;
    Presence presence = Presence::kOtherwise;
    bool* is_there = nullptr;
  };

 private:
  /// The number itself, or that of a Quantity.
  template <class T>
  static auto& number_of(T& value) {
    if constexpr (requires { value.value; }) {
      return value.value;
    } else {
      return value;
    }
  }
  template <class Integer>
  void whole(const Key& key, std::int64_t low, std::int64_t high, Integer& value,
             Presence presence) {
    auto given = static_cast<std::int64_t>(value);
    field({key, "", {}, Whole{low, high, &given}, presence});
    value = static_cast<Integer>(given);
  }
  template <class Options, class E>
  void one_of_options(const Key& key, const Options& options, E& value, Presence presence) {
    std::size_t index = index_in(options, value);
    field({key, "", {}, Choice{names(options), &index}, presence});
    value = options[index].value;
  }
  /// Of a value that is among the options: a file must be able to state it.
  template <class Options, class E>
  static std::size_t index_in(const Options& options, const E& value) {
    const auto found = find(options, value);
    BARAKA_CHECK(found != options.end());
    return static_cast<std::size_t>(found - options.begin());
  }
  template <class Options, class E>
  static auto find(const Options& options, const E& value) {
    return std::ranges::find_if(options, [&](const auto& one) { return one.value == value; });
  }
  template <class Options>
  static std::vector<std::string> names(const Options& options) {
    std::vector<std::string> result;
    result.reserve(options.size());
    for (const auto& option : options) result.emplace_back(option.name);
    return result;
  }
  template <class V>
  bool describe_from(std::span<const Alternative<V>> alternatives, const BodyOf<V>& body,
                     const std::function<void(Fields&)>& otherwise) {
    if (alternatives.empty()) {
      otherwise(*this);
      return true;
    }
    const Alternative<V>& first = alternatives.front();
    V made = first.make();
    inside_if_there(first.key, [&](Fields& io) { body(io, made); });
    only(true, {first.key.name, {"absent"}}, "",
         [&](Fields& io) { io.describe_from<V>(alternatives.subspan(1), body, otherwise); });
    return true;
  }
  /// @return whether a value was read.
  bool field_given(Field f, bool is_there) {
    f.presence = Presence::kGiven;
    f.is_there = &is_there;
    field(f);
    return reading() != nullptr && is_there;
  }
  /// Whether keys are only described, without regard to the values on which they depend.
  virtual bool is_describing() const { return false; }
  /// One of several alternative mappings.
  virtual void inside_if_there(const Key& key, const std::function<void(Fields&)>& body) {
    inside(key, body);
  }
  virtual void field(const Field& field) = 0;
  /// @param kind  to be written, or the default without the key.
  /// @param keys  describes the keys of the kind with that index.
  virtual void kind_field(const Key& key, std::vector<std::string> names,
                          std::optional<std::size_t> kind, Presence presence,
                          const std::function<void(Fields&, std::size_t)>& keys) = 0;
  /// @param count  number of items to write.
  virtual void each(const Key& key, std::size_t count,
                    const std::function<void(Fields&, std::size_t)>& body) = 0;
};

/// One alternative of a variant, selected in files by this key.
template <class V, class T>
Fields::Alternative<V> alternative(Key key) {
  return {std::move(key), []() -> V { return T{}; }};
}

/// The first `kCount` alternatives of a variant, as kinds.
/// @param name_of  returns the name of the alternative that it is given.
template <class V, std::size_t kCount = std::variant_size_v<V>, class Name>
auto kinds_of(Name name_of) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...> /*all*/) {
    return std::array<Fields::Kind<V>, kCount>{
        {{name_of(std::variant_alternative_t<kIndex, V>{}),
          +[]() -> V { return std::variant_alternative_t<kIndex, V>{}; }}...}};
  }
  (std::make_index_sequence<kCount>{});
}

/// The variant as this alternative; it is set to it if it has another.
template <class T, class V>
T& as(V& variant) {
  if (T* const there = std::get_if<T>(&variant)) return *there;
  variant = T{};
  return std::get<T>(variant);
}

/// Optional key `version` of a file.
void version_key(Fields& io);
/// Required key `version`.
void needed_version_key(Fields& io);

}  // namespace hal::files::description
