#include "results/record/topic_name.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>

namespace results::record {
namespace {

bool stays(char c) {
  const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  return is_letter || (c >= '0' && c <= '9') || c == '_' || c == '-' || c == '/';
}

}  // namespace

std::string topic_part(std::string_view topic) {
  std::string part;
  for (const char c : topic) {
    if (stays(c)) {
      part += c;
    } else {
      part += fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return part;
}

std::string topic_of_part(std::string_view part) {
  std::string topic;
  for (std::size_t i = 0; i < part.size(); ++i) {
    unsigned octet = 0;
    const char* const digits = part.data() + i + 1;
    if (part[i] != '%' || i + 2 >= part.size() ||
        std::from_chars(digits, digits + 2, octet, 16).ptr != digits + 2) {
      topic += part[i];
      continue;
    }
    topic += static_cast<char>(octet);
    i += 2;
  }
  return topic;
}

}  // namespace results::record
