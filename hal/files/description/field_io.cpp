#include "hal/files/description/field_io.h"

#include "hal/types/overloaded.h"

namespace hal::files::description {

void version_key(Fields& io) {
  if (io.is_writing()) return;
  int version = 1;
  io.count({"version", "Version of the file format.", "1"}, 1, 1, version);
}

void needed_version_key(Fields& io) {
  int version = 1;
  io.needed_count({"version", "Version of the file format.", "1"}, 1, 1, version);
}

void FieldReader::inside(const Key& key, const std::function<void(Fields&)>& body) {
  Mapping inner = in_.mapping(key);
  FieldReader reader(inner);
  body(reader);
  inner.finish();
}

void FieldReader::own(const Key& /*key*/, const Form& /*form*/,
                      const std::function<void(Mapping&)>& read,
                      const std::function<void(Writer&)>& /*write*/) {
  read(in_);
}

void FieldReader::each(const Key& key, std::size_t /*count*/,
                       const std::function<void(Fields&, std::size_t)>& body) {
  std::size_t index = 0;
  for (Mapping& item : in_.mappings(key)) {
    FieldReader reader(item);
    body(reader, index++);
    item.finish();
  }
}

void FieldReader::only(bool applies, const When& /*when*/, const std::string& why,
                       const std::function<void(Fields&)>& body) {
  if (applies) return body(*this);
  FieldNames names;
  body(names);
  for (const std::string& name : names.all()) in_.refuse(name, why);
}

void FieldReader::named(const Key& each, const std::vector<std::string>& /*names*/,
                        const std::function<void(Fields&, const std::string&)>& body) {
  for (const std::string& name : in_.keys()) {
    Mapping inner = in_.mapping({name, each.meaning});
    FieldReader reader(inner);
    body(reader, name);
    inner.finish();
  }
}

bool FieldReader::first_of(const std::vector<Saying>& sayings) {
  const std::vector<std::string> keys = in_.keys();
  const auto said = std::ranges::find_if(
      sayings, [&](const Saying& one) { return std::ranges::count(keys, one.key) > 0; });
  if (said == sayings.end()) return false;
  said->body(*this);
  return true;
}

void FieldReader::kind_field(const Key& key, std::vector<std::string> names,
                             std::optional<std::size_t> kind, Presence presence,
                             const std::function<void(Fields&, std::size_t)>& keys) {
  if (kind && presence == Presence::kOtherwise)
    return keys(*this, in_.choice(key, std::move(names), *kind));
  const std::optional<std::size_t> named = in_.choice(key, std::move(names));
  if (!named) return in_.leave_rest();  // it decides which of the other keys are valid
  keys(*this, *named);
}

/// Visitor that reads a value of each form.
struct FieldReader::ReadValue {
  Mapping& in;
  const Field& f;
  bool is_needed;

  void operator()(double* v) const {
    *v = is_needed ? in.number(f.key, f.unit, f.range) : in.number(f.key, f.unit, f.range, *v);
  }
  void operator()(Vec2* v) const {
    *v = is_needed ? in.vec2(f.key, f.unit, f.range) : in.vec2(f.key, f.unit, f.range, *v);
  }
  void operator()(Vec3* v) const {
    if (is_needed || in.has(f.key.name)) *v = in.vec3(f.key, f.unit, f.range);
  }
  void operator()(const Whole& w) const {
    *w.value =
        is_needed ? in.integer(f.key, w.low, w.high) : in.integer(f.key, w.low, w.high, *w.value);
  }
  void operator()(Duration* v) const {
    *v = is_needed ? in.duration(f.key, f.range) : in.duration(f.key, f.range, *v);
  }
  void operator()(std::optional<Duration>* v) const {
    *v = in.optional_duration(f.key, f.range.low, *v);
  }
  void operator()(bool* v) const { *v = in.flag(f.key, *v); }
  void operator()(std::string* v) const { *v = is_needed ? in.text(f.key) : in.text(f.key, *v); }
  void operator()(std::vector<std::string>* v) const {
    const std::vector<config::Scalar> given = in.texts(f.key);
    v->clear();
    v->reserve(given.size());
    for (const config::Scalar& one : given) v->push_back(one.text);
  }
  void operator()(const Choice& c) const {
    *c.value = is_needed ? in.choice(f.key, c.names).value_or(*c.value)
                         : in.choice(f.key, c.names, *c.value);
  }
};

void FieldReader::field(const Field& f) {
  if (f.presence == Presence::kGiven) {
    *f.is_there = in_.has(f.key.name);
    if (!*f.is_there) return;
  }
  std::visit(ReadValue{in_, f, f.presence != Presence::kOtherwise}, f.value);
}

void FieldWriter::inside(const Key& key, const std::function<void(Fields&)>& body) {
  out_.open(key.name);
  body(*this);
  out_.close();
}

void FieldWriter::own(const Key& /*key*/, const Form& /*form*/,
                      const std::function<void(Mapping&)>& /*read*/,
                      const std::function<void(Writer&)>& write) {
  write(out_);
}

void FieldWriter::each(const Key& key, std::size_t count,
                       const std::function<void(Fields&, std::size_t)>& body) {
  out_.open_list(key.name);
  for (std::size_t index = 0; index < count; ++index) {
    out_.open_item();
    body(*this, index);
    out_.close();
  }
  out_.close();
}

void FieldWriter::only(bool applies, const When& /*when*/, const std::string& /*why*/,
                       const std::function<void(Fields&)>& body) {
  if (applies) body(*this);
}

void FieldWriter::named(const Key& /*each*/, const std::vector<std::string>& names,
                        const std::function<void(Fields&, const std::string&)>& body) {
  for (const std::string& name : names) {
    out_.open(name);
    body(*this, name);
    out_.close();
  }
}

bool FieldWriter::first_of(const std::vector<Saying>& sayings) {
  const auto said = std::ranges::find(sayings, true, &Saying::is_it);
  if (said == sayings.end()) return false;
  said->body(*this);
  return true;
}

void FieldWriter::kind_field(const Key& key, std::vector<std::string> names,
                             std::optional<std::size_t> kind, Presence /*presence*/,
                             const std::function<void(Fields&, std::size_t)>& keys) {
  BARAKA_CHECK(kind.has_value());  // a file must be able to state it
  out_.text(key.name, names[*kind]);
  keys(*this, *kind);
}

void FieldWriter::field(const Field& f) {
  if (f.presence == Presence::kGiven && !*f.is_there) return;
  const std::string& name = f.key.name;
  std::visit(Overloaded{[&](const double* v) { out_.number(name, *v, f.unit); },
                        [&](const Vec2* v) {
                          out_.numbers(name, {v->x, v->y}, f.unit);
                        },
                        [&](const Vec3* v) {
                          out_.numbers(name, {v->x, v->y, v->z}, f.unit);
                        },
                        [&](const Whole& w) { out_.integer(name, *w.value); },
                        [&](const Duration* v) { out_.duration(name, *v); },
                        [&](const std::optional<Duration>* v) {
                          if (*v) {
                            out_.duration(name, **v);
                          } else {
                            out_.text(name, "none");
                          }
                        },
                        [&](const bool* v) { out_.flag(name, *v); },
                        [&](const std::string* v) { out_.text(name, *v); },
                        [&](const std::vector<std::string>* v) { out_.texts(name, *v); },
                        [&](const Choice& c) { out_.text(name, c.names[*c.value]); }},
             f.value);
}

}  // namespace hal::files::description
