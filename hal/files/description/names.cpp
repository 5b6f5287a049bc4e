#include "hal/files/description/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace hal::files::description {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

}  // namespace

bool are_name_characters(std::string_view text) {
  return std::ranges::all_of(
      text, [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
}

bool may_be_named(std::string_view name) {
  return !name.empty() && is_letter(name.front()) && are_name_characters(name);
}

void check_name(Fields& io, std::string_view name) {
  if (name.empty() || may_be_named(name)) return;
  io.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-' after a letter", name));
}

void check_folder_name(Fields& io, std::string_view name) {
  if (are_name_characters(name)) return;
  io.mistake("name", fmt::format("'{}' must be letters, digits, '_' and '-'", name));
}

}  // namespace hal::files::description
