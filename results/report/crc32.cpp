#include "results/report/crc32.h"

#include <array>

namespace results::report {
namespace {

constexpr std::uint32_t kPolynomial = 0xedb88320;  // least significant bit first

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1) ^ ((rest & 1) != 0 ? kPolynomial : 0);
    table[byte] = rest;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kCrcTable = crc_table();

}  // namespace

void Crc32::add(std::string_view bytes) {
  for (const char byte : bytes) {
    state_ = (state_ >> 8) ^ kCrcTable[(state_ ^ static_cast<std::uint8_t>(byte)) & 0xff];
  }
}

std::uint32_t crc32(std::string_view bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace results::report
