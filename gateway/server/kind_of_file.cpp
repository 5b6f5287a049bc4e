#include "gateway/server/kind_of_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/files/config/document.h"
#include "hal/files/config/errors.h"
#include "hal/types/check.h"

namespace gateway::server {
namespace {

using hal::files::config::ConfigErrors;
using Keys = std::vector<std::string>;

struct Words {
  std::string_view kind;
  std::string_view use;
  /// Keys of the top level; one of them identifies the kind if no row above has matched.
  std::vector<std::string_view> keys;
};

const std::vector<Words>& words() {
  static const std::vector<Words> rows = {
      {"hardware", "`baraka-agentd FILE` serves it", {"agent"}},
      {"fleet", "`baraka fleet FILE` runs it", {"need"}},
      {"campaign", "`baraka campaign FILE` runs it", {"vary", "scenario"}},
      {"scenario", "`baraka run FILE` runs it", {"agents", "end"}},
      {"radio", "scenarios include it: radio: {include: FILE}", {"profile"}},
      {"mote", "scenarios include it: mote: {include: FILE}", {"size", "mass"}},
      {"robot", "scenarios include it: robot: {include: FILE}", {"model"}}};
  return rows;
}

bool has_one_of(const Keys& keys, const std::vector<std::string_view>& telling) {
  return std::ranges::any_of(
      telling, [&](std::string_view key) { return std::ranges::find(keys, key) != keys.end(); });
}

/// The message that a file is of another kind; nullopt: it may be a hardware file.
std::optional<std::string> told_by(const Keys& keys, const std::string& file) {
  const auto row =
      std::ranges::find_if(words(), [&](const Words& one) { return has_one_of(keys, one.keys); });
  if (row == words().end() || row->kind == "hardware") return std::nullopt;
  return fmt::format("{}: is a {} file, not a hardware file; {}", file, row->kind, row->use);
}

}  // namespace

std::string use_of(const std::string& kind) {
  const auto row = std::ranges::find(words(), kind, &Words::kind);
  BARAKA_CHECK(row != words().end());
  return std::string(row->use);
}

int with_hardware_file(const std::string& file, const std::function<int()>& act) {
  try {
    return act();
  } catch (const ConfigErrors& mistakes) {
    std::optional<std::string> other;
    try {
      other = told_by(hal::files::config::Document::load(file).root().keys(), file);
    } catch (const ConfigErrors&) {
      throw mistakes;  // it cannot be read
    }
    if (other) throw ConfigErrors({*other});
    throw;
  }
}

}  // namespace gateway::server
