#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/files/description/fields.h"

namespace hal::files::description {

/// Reads the fields of a struct from a mapping, which must outlive it and records the mistakes.
class FieldReader final : public Fields {
 public:
  using Fields::own;
  explicit FieldReader(Mapping& in) : in_(in) {}

  void inside(const Key& key, const std::function<void(Fields&)>& body) override;
  void own(const Key& key, const Form& form, const std::function<void(Mapping&)>& read,
           const std::function<void(Writer&)>& write) override;
  void only(bool applies, const When& when, const std::string& why,
            const std::function<void(Fields&)>& body) override;
  void named(const Key& each, const std::vector<std::string>& names,
             const std::function<void(Fields&, const std::string&)>& body) override;
  bool first_of(const std::vector<Saying>& sayings) override;
  void unused(const std::string& key, const std::string& why) override { in_.refuse(key, why); }
  Mapping* reading() override { return &in_; }

 private:
  struct ReadValue;
  void field(const Field& field) override;
  void kind_field(const Key& key, std::vector<std::string> names, std::optional<std::size_t> kind,
                  Presence presence,
                  const std::function<void(Fields&, std::size_t)>& keys) override;
  void each(const Key& key, std::size_t count,
            const std::function<void(Fields&, std::size_t)>& body) override;

  Mapping& in_;
};

/// Writes the same fields.
class FieldWriter final : public Fields {
 public:
  using Fields::own;
  explicit FieldWriter(Writer& out) : out_(out) {}

  bool is_writing() const override { return true; }
  void inside(const Key& key, const std::function<void(Fields&)>& body) override;
  void own(const Key& key, const Form& form, const std::function<void(Mapping&)>& read,
           const std::function<void(Writer&)>& write) override;
  void only(bool applies, const When& when, const std::string& why,
            const std::function<void(Fields&)>& body) override;
  void named(const Key& each, const std::vector<std::string>& names,
             const std::function<void(Fields&, const std::string&)>& body) override;
  bool first_of(const std::vector<Saying>& sayings) override;
  void unused(const std::string& /*key*/, const std::string& /*why*/) override {}

 private:
  void field(const Field& field) override;
  void kind_field(const Key& key, std::vector<std::string> names, std::optional<std::size_t> kind,
                  Presence presence,
                  const std::function<void(Fields&, std::size_t)>& keys) override;
  void each(const Key& key, std::size_t count,
            const std::function<void(Fields&, std::size_t)>& body) override;

  Writer& out_;
};

/// Lists all keys of the same struct, used or unused, but not those of inner mappings.
class FieldNames final : public Fields {
 public:
  using Fields::own;
  const std::vector<std::string>& all() const { return names_; }
  bool has(std::string_view name) const { return std::ranges::count(names_, name) > 0; }

  void inside(const Key& key, const std::function<void(Fields&)>& /*body*/) override {
    add(key.name);
  }
  void own(const Key& key, const Form& /*form*/, const std::function<void(Mapping&)>& /*read*/,
           const std::function<void(Writer&)>& /*write*/) override {
    add(key.name);
  }
  void only(bool /*applies*/, const When& /*when*/, const std::string& /*why*/,
            const std::function<void(Fields&)>& body) override {
    body(*this);
  }
  void named(const Key& /*each*/, const std::vector<std::string>& /*names*/,
             const std::function<void(Fields&, const std::string&)>& /*body*/) override {}
  bool first_of(const std::vector<Saying>& sayings) override {
    for (const Saying& saying : sayings) saying.body(*this);
    return true;
  }
  void unused(const std::string& key, const std::string& /*why*/) override { add(key); }

 private:
  bool is_describing() const override { return true; }
  void field(const Field& field) override { add(field.key.name); }
  void kind_field(const Key& key, std::vector<std::string> /*names*/,
                  std::optional<std::size_t> kind, Presence /*presence*/,
                  const std::function<void(Fields&, std::size_t)>& keys) override {
    add(key.name);
    if (kind) keys(*this, *kind);
  }
  void each(const Key& key, std::size_t /*count*/,
            const std::function<void(Fields&, std::size_t)>& /*body*/) override {
    add(key.name);
  }
  void add(const std::string& name) {
    if (!has(name)) names_.push_back(name);
  }

  std::vector<std::string> names_;
};

}  // namespace hal::files::description
