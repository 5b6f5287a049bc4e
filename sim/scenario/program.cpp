#include "sim/scenario/program.h"

#include <fmt/format.h>

namespace sim::scenario {

std::string filled_in(std::string text, const ProgramWords& words) {
  const std::array<std::pair<std::string_view, const std::string*>, 4> all{
      {{kAgentWord, &words.agent},
       {kAddressWord, &words.address},
       {kNumberWord, &words.number},
       {kResultsWord, &words.results}}};
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at)) {
    std::size_t skip = 1;
    for (const auto& [word, value] : all) {
      if (text.compare(at, word.size(), word) != 0) continue;
      text.replace(at, word.size(), *value);
      skip = value->size();
      break;
    }
    at += skip;
  }
  return text;
}

std::string dotted(std::uint32_t address) {
  return fmt::format("{}.{}.{}.{}", address >> 24, address >> 16 & 0xff, address >> 8 & 0xff,
                     address & 0xff);
}

}  // namespace sim::scenario
