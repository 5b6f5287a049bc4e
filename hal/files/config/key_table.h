#pragma once

#include <string>
#include <vector>

#include "hal/files/config/key.h"

namespace hal::files::config {

/// A key counts only with these values of another one, or only with or without another one.
struct Condition {
  std::string path;  ///< Of the other key.
  bool presence = false;
  std::vector<std::string> values;  ///< Of a choice; "there" or "absent" of a presence.
};

/// One key of a kind of file.
struct KeyDescription {
  /// Default and limits, where the value of another key (`with`) decides them.
  struct Variant {
    std::string with;       ///< "ieee80211b"; empty: always.
    std::string otherwise;  ///< What counts when the key is absent; empty: it must be given.
    std::string limits;
  };

  std::string path;  ///< Dotted; "[]" behind the name of a list; NAME for a name of one's own.
  std::string meaning, example;
  Form form;
  bool optional = false;              ///< Absent, it is nothing.
  std::vector<Variant> variants;      ///< At least one.
  std::vector<Condition> conditions;  ///< Those that its mapping does not have anyway.
};

}  // namespace hal::files::config
