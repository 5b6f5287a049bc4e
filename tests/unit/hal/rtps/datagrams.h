#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/rtps/cursor.h"

namespace hal::rtps {

using Datagram = std::vector<std::uint8_t>;

inline Octets octets_of(const Datagram& datagram) { return std::as_bytes(std::span(datagram)); }

/// "15 05 0800" to octets; blanks mean nothing.
inline Datagram from_hex(const std::string& text) {
  Datagram datagram;
  std::string digits;
  for (const char c : text) {
    if (c != ' ') digits += c;
    if (digits.size() < 2) continue;
    datagram.push_back(static_cast<std::uint8_t>(std::stoi(digits, nullptr, 16)));
    digits.clear();
  }
  return datagram;
}

/// Real datagrams, see the files.
inline std::vector<Datagram> recorded(const std::string& implementation) {
  std::ifstream file(TESTS_DIR "/unit/hal/rtps/datagrams/" + implementation + ".hex");
  std::vector<Datagram> datagrams;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('#')) datagrams.push_back(from_hex(line));
  }
  if (datagrams.empty()) throw std::runtime_error("no datagrams of " + implementation);
  return datagrams;
}

/// "RTPS", version 2.3, a vendor, and a participant.
inline const char* const kHeader = "52545053 0203 010f 010f0102030405060708090a";

/// That header and submessages, as octets.
inline Datagram datagram(const std::string& submessages) {
  return from_hex(std::string(kHeader) + submessages);
}

}  // namespace hal::rtps
