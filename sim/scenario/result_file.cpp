#include "sim/scenario/result_file.h"

#include <fmt/format.h>

#include "hal/files/description/names.h"

namespace sim::scenario {

void check_result_file(Fields& io, const std::string& key, const std::string& name,
                       std::string filled_in, std::string_view ending) {
  const bool has_stem = filled_in.size() > ending.size() && filled_in.front() != '.';
  const bool has_ending = filled_in.ends_with(ending);
  std::erase(filled_in, '.');
  if (has_stem && has_ending && hal::files::description::are_name_characters(filled_in)) return;
  io.mistake(key, fmt::format("'{}' must be a name of letters, digits, '_', '-' and '.' that ends "
                              "in {}, without a folder: it goes to the results",
                              name, ending));
}

}  // namespace sim::scenario
