#include "gateway/commands/wrong_kind.h"

#include <fmt/format.h>

#include <optional>

#include "gateway/commands/file_kinds.h"
#include "hal/config/document.h"
#include "hal/config/errors.h"
#include "hal/config/shared_folders.h"

namespace gateway {
namespace {

using hal::config::ConfigErrors;

/// Nothing if it may be of the kind that is wanted. @throws ConfigErrors if it cannot be read.
std::optional<std::string> other_kind(const std::string& file, const std::string& wanted) {
  if (hal::config::Document::load(file).root().keys().empty()) {
    return fmt::format("{}: is empty: it has no key of a {}; `baraka describe {}` shows one", file,
                       wanted, wanted);
  }
  const FileKind& kind = recognised(file, {});
  if (kind.name == wanted) return std::nullopt;
  return fmt::format("{}: is a {} file, not a {}; {}", file, kind.name, wanted, kind.use);
}

}  // namespace

int with_file_of(const std::string& kind, const std::string& given,
                 const std::vector<std::string>& folders, const std::function<int()>& act) {
  try {
    return act();
  } catch (const ConfigErrors& mistakes) {
    std::optional<std::string> other;
    try {
      other = other_kind(hal::config::named_file(given, folders).string(), kind);
    } catch (const ConfigErrors&) {
      throw mistakes;  // it cannot be read, or may be of several kinds
    }
    if (other) throw ConfigErrors({*other});
    throw;
  }
}

}  // namespace gateway
