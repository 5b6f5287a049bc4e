#pragma once

#include <map>
#include <string>
#include <vector>

#include "hal/files/config/key_table.h"
#include "hal/files/description/fields.h"

namespace hal::files::description {

/// Describes the keys of a kind of file. The function over Fields that describes a struct runs
/// once, over the struct with its defaults, and visits every possible key, whatever other values it
/// depends on.
class KeyDescriber final : public Fields {
 public:
  /// In the order of description, grouped by mapping.
  std::vector<config::KeyDescription> keys() const;

  using Fields::own;
  void inside(const Key& key, const std::function<void(Fields&)>& body) override;
  void own(const Key& key, const Form& form, const std::function<void(Mapping&)>& read,
           const std::function<void(Writer&)>& write) override;
  void only(bool applies, const When& when, const std::string& why,
            const std::function<void(Fields&)>& body) override;
  void named(const Key& each, const std::vector<std::string>& /*names*/,
             const std::function<void(Fields&, const std::string&)>& body) override {
    inside(each, [&](Fields& io) { body(io, each.name); });
  }
  bool first_of(const std::vector<Saying>& sayings) override {
    for (const Saying& saying : sayings) saying.body(*this);
    return true;
  }
  void unused(const std::string& /*key*/, const std::string& /*why*/) override {}

 private:
  /// Default and form of a key under certain conditions.
  struct Version {
    std::string otherwise;
    Form form;
    std::vector<config::Condition> conditions;
  };
  struct Noted {
    std::string path, meaning, example;
    bool optional = false;
    std::vector<Version> versions;
  };

  bool is_describing() const override { return true; }
  void inside_if_there(const Key& key, const std::function<void(Fields&)>& body) override;
  void field(const Field& field) override;
  void kind_field(const Key& key, std::vector<std::string> names, std::optional<std::size_t> kind,
                  Presence presence,
                  const std::function<void(Fields&, std::size_t)>& keys) override;
  void each(const Key& key, std::size_t count,
            const std::function<void(Fields&, std::size_t)>& body) override;

  std::string path_of(const std::string& key) const;
  void note(const Key& key, Form form, std::string otherwise, bool optional = false);
  /// Runs a body inside a mapping, or under a condition.
  void within(const std::string& key, const std::function<void(Fields&)>& body);
  void under(config::Condition condition, const std::function<void(Fields&)>& body);
  config::KeyDescription described(const Noted& noted) const;

  std::string path_;
  std::vector<config::Condition> conditions_;
  std::vector<Noted> noted_;
  std::map<std::string, std::size_t> places_;                ///< Index in noted_ by path.
  std::map<std::string, std::vector<std::string>> options_;  ///< Options of choices, by path.
};

}  // namespace hal::files::description
