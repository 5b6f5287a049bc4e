#include "hal/files/description/key_describer.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <utility>

#include "hal/files/config/value.h"
#include "hal/types/overloaded.h"

namespace hal::files::description {

using config::Condition;

using config::KeyDescription;
using config::readable;

std::string KeyDescriber::path_of(const std::string& key) const {
  if (key.starts_with('.')) return key.substr(1);
  return path_.empty() ? key : fmt::format("{}.{}", path_, key);
}

void KeyDescriber::note(const Key& key, Form form, std::string otherwise, bool optional) {
  const std::string path = path_of(key.name);
  const auto [place, is_new] = places_.try_emplace(path, noted_.size());
  if (is_new)
    noted_.push_back({path, std::string(key.meaning), std::string(key.example), optional, {}});
  if (form.kind == Form::Kind::kChoice) options_[path] = form.options;
  if (!key.otherwise.empty()) otherwise = key.otherwise;
  noted_[place->second].versions.push_back({std::move(otherwise), std::move(form), conditions_});
}

void KeyDescriber::within(const std::string& key, const std::function<void(Fields&)>& body) {
  const std::string outer = std::exchange(path_, path_of(key));
  body(*this);
  path_ = outer;
}

void KeyDescriber::under(Condition condition, const std::function<void(Fields&)>& body) {
  conditions_.push_back(std::move(condition));
  body(*this);
  conditions_.pop_back();
}

void KeyDescriber::inside(const Key& key, const std::function<void(Fields&)>& body) {
  note(key, {.kind = Form::Kind::kMapping}, "none");
  within(key.name, body);
}

void KeyDescriber::inside_if_there(const Key& key, const std::function<void(Fields&)>& body) {
  note(key, {.kind = Form::Kind::kMapping}, "none", true);
  within(key.name, body);
}

void KeyDescriber::own(const Key& key, const Form& form,
                       const std::function<void(Mapping&)>& /*read*/,
                       const std::function<void(Writer&)>& /*write*/) {
  note(key, form, "none");
}

void KeyDescriber::only(bool /*applies*/, const When& when, const std::string& /*why*/,
                        const std::function<void(Fields&)>& body) {
  if (when.key.empty()) return body(*this);
  const bool is_presence = when.values.front() == "there" || when.values.front() == "absent";
  under({path_of(when.key), is_presence, when.values}, body);
}

void KeyDescriber::kind_field(const Key& key, std::vector<std::string> names,
                              std::optional<std::size_t> kind, Presence presence,
                              const std::function<void(Fields&, std::size_t)>& keys) {
  const bool may_be_absent = kind && presence == Presence::kOtherwise;
  note(key, {.kind = Form::Kind::kChoice, .options = names}, may_be_absent ? names[*kind] : "");
  for (std::size_t i = 0; i < names.size(); ++i)
    under({path_of(key.name), false, {names[i]}}, [&](Fields& io) { keys(io, i); });
}

void KeyDescriber::each(const Key& key, std::size_t count,
                        const std::function<void(Fields&, std::size_t)>& body) {
  note(key, {.kind = Form::Kind::kMappings}, "none");
  within(key.name + "[]", [&](Fields& io) { body(io, count); });
}

void KeyDescriber::field(const Field& f) {
  const auto number = [&](std::size_t size) {
    return size == 1
               ? Form{.kind = Form::Kind::kNumber, .unit = f.unit, .range = f.range}
               : Form{.kind = Form::Kind::kVector, .unit = f.unit, .range = f.range, .size = size};
  };
  const auto say = [&](Form form, std::string otherwise) {
    if (f.presence != Presence::kOtherwise) otherwise.clear();
    note(f.key, std::move(form), std::move(otherwise), f.presence == Presence::kGiven);
  };
  std::visit(
      Overloaded{
          [&](const double* v) { say(number(1), readable(*v, f.unit)); },
          [&](const Vec2* v) {
            say(number(2), fmt::format("[{}, {}]", readable(v->x, f.unit), readable(v->y, f.unit)));
          },
          [&](const Vec3* /*v*/) { say(number(3), ""); },
          [&](const Whole& w) {
            say({.kind = Form::Kind::kWhole, .low = w.low, .high = w.high},
                fmt::format("{}", *w.value));
          },
          [&](const Duration* v) { say(number(1), config::format_duration(*v)); },
          [&](const std::optional<Duration>* v) {
            say(number(1), *v ? config::format_duration(**v) : "none");
          },
          [&](const bool* v) { say({.kind = Form::Kind::kFlag}, *v ? "true" : "false"); },
          [&](const std::string* v) { say({.kind = Form::Kind::kText}, *v); },
          [&](const std::vector<std::string>*) { say({.kind = Form::Kind::kTexts}, "none"); },
          [&](const Choice& c) {
            say({.kind = Form::Kind::kChoice, .options = c.names}, c.names[*c.value]);
          }},
      f.value);
}

namespace {

using Conditions = std::vector<Condition>;

/// Combines a condition with the values of all others on the same key; without values if one of the
/// sets has no such condition.
Condition joined(Condition condition, std::span<const Conditions> others) {
  for (const Conditions& other : others) {
    const auto same = std::ranges::find_if(other, [&](const Condition& one) {
      return one.path == condition.path && one.presence == condition.presence;
    });
    if (same == other.end()) return {condition.path, condition.presence, {}};
    std::ranges::copy_if(
        same->values, std::back_inserter(condition.values),
        [&](const std::string& value) { return std::ranges::count(condition.values, value) == 0; });
  }
  return condition;
}

/// Conditions that apply to all versions of a key: conditions on the same key are joined; those
/// that some versions lack, or that permit every value, are dropped.
Conditions joined(const std::vector<Conditions>& all,
                  const std::map<std::string, std::vector<std::string>>& options) {
  Conditions result;
  for (const Condition& first : all.front()) {
    Condition condition = joined(first, std::span(all).subspan(1));
    const auto choice = options.find(condition.path);
    const std::size_t most =
        condition.presence || choice == options.end() ? 2 : choice->second.size();
    if (!condition.values.empty() && condition.values.size() < most)
      result.push_back(std::move(condition));
  }
  return result;
}

/// The value that distinguishes a version: that of its innermost condition.
std::string with_of(const std::vector<Condition>& conditions) {
  return conditions.empty() || conditions.back().values.empty() ? ""
                                                                : conditions.back().values.front();
}

}  // namespace

KeyDescription KeyDescriber::described(const Noted& noted) const {
  const Version& first = noted.versions.front();
  KeyDescription key{.path = noted.path,
                     .meaning = noted.meaning,
                     .example = noted.example,
                     .form = first.form,
                     .optional = noted.optional,
                     .variants = {{"", first.otherwise, limits(first.form)}},
                     .conditions = {}};
  std::vector<std::vector<Condition>> all;
  std::vector<KeyDescription::Variant> variants;
  for (const Version& version : noted.versions) {
    all.push_back(version.conditions);
    variants.push_back({with_of(version.conditions), version.otherwise, limits(version.form)});
  }
  const bool differ = std::ranges::any_of(variants, [&](const auto& other) {
    return other.otherwise != variants.front().otherwise || other.limits != variants.front().limits;
  });
  if (differ) key.variants = std::move(variants);
  key.conditions = joined(all, options_);
  return key;
}

namespace {

std::string outer_path(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

bool are_equal(const Condition& a, const Condition& b) {
  return a.path == b.path && a.presence == b.presence && a.values == b.values;
}

using ByMapping = std::map<std::string, std::vector<KeyDescription>>;

/// Appends the keys of a mapping. Conditions of the mapping apply to its keys and are not repeated.
void append(const std::string& mapping, const std::vector<Condition>& known, ByMapping& all,
            std::vector<KeyDescription>& out) {
  const std::vector<KeyDescription> keys = std::exchange(all[mapping], {});
  for (KeyDescription key : keys) {
    std::erase_if(key.conditions, [&](const Condition& condition) {
      return std::ranges::any_of(known,
                                 [&](const auto& other) { return are_equal(condition, other); });
    });
    out.push_back(std::move(key));
  }
  for (const KeyDescription& key : keys) {
    for (const char* ending : {"", "[]"}) append(key.path + ending, key.conditions, all, out);
  }
}

}  // namespace

std::vector<KeyDescription> KeyDescriber::keys() const {
  ByMapping all;
  for (const Noted& noted : noted_) all[outer_path(noted.path)].push_back(described(noted));
  std::vector<KeyDescription> result;
  result.reserve(noted_.size());
  append("", {}, all, result);
  return result;
}

}  // namespace hal::files::description
