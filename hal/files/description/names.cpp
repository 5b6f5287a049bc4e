#include "hal/files/description/names.h"

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

}  // namespace hal::files::description
