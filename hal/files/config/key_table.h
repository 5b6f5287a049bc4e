#pragma once

#include <string>
#include <vector>

#include "hal/files/config/key.h"

namespace hal::files::config {

/// A key is used only with these values of another key, or only with or without another key.
struct Condition {
  std::string path;  ///< Path of the other key.
  bool presence = false;
  std::vector<std::string> values;  ///< Names of a choice; "there" or "absent" for a presence.
};

/// One key of a kind of file.
struct KeyDescription {
  /// Default and limits, if they depend on the value `with` of another key.
  struct Variant {
    std::string with;       ///< "ieee80211b"; empty: always.
    std::string otherwise;  ///< What applies when the key is absent; empty: the key is required.
    std::string limits;
  };

  std::string path;  ///< Dotted; "[]" after the name of a list; NAME for a name chosen by the user.
  std::string meaning, example;
  Form form;
  bool optional = false;              ///< If absent, the feature is not used.
  std::vector<Variant> variants;      ///< At least one.
  std::vector<Condition> conditions;  ///< In addition to those of its mapping.
};

}  // namespace hal::files::config
