#include "baraka/run/network/neighbour_tables.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace baraka::run::network {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream stream(line);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Sum of the column over all processors; none: there is no such file or column.
std::optional<std::uint64_t> sum_of(const char* file, const std::string& column) {
  constexpr int kHexadecimal = 16;
  std::ifstream table(file);
  std::string line;
  if (!std::getline(table, line)) return std::nullopt;
  const std::vector<std::string> columns = words_of(line);
  const auto found = std::ranges::find(columns, column);
  if (found == columns.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(found - columns.begin());
  std::uint64_t sum = 0;
  while (std::getline(table, line)) {
    const std::vector<std::string> values = words_of(line);
    if (index < values.size()) sum += std::stoull(values[index], nullptr, kHexadecimal);
  }
  return sum;
}

}  // namespace

std::optional<std::uint64_t> neighbour_table_overflows() {
  const auto arp = sum_of("/proc/net/stat/arp_cache", "table_fulls");
  if (!arp) return std::nullopt;
  return *arp + sum_of("/proc/net/stat/ndisc_cache", "table_fulls").value_or(0);
}

}  // namespace baraka::run::network
