#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tests/unit/hal/files/recording/bags.h"

namespace hal::files::recording {

/// A packet of the captures of sim/air/ledger, whose README tells what programs sent.
struct EthernetFrame {
  std::uint32_t seconds = 0, microseconds = 0;
  std::string octets;
};

inline std::string real_capture(const std::string& name) {
  return content_of(TESTS_DIR "/unit/sim/air/ledger/captures/" + name);
}

/// A number of `size` octets in either order of bytes.
inline std::string number(std::uint64_t value, int size, bool is_big) {
  std::string text;
  for (int i = 0; i < size; ++i) {
    const int shift = 8 * (is_big ? size - 1 - i : i);
    text += static_cast<char>(value >> shift & 0xff);
  }
  return text;
}

/// Frames of a little-endian pcap with microseconds, as tcpdump wrote it.
inline std::vector<EthernetFrame> frames_of(const std::string& pcap) {
  const auto word = [&pcap](std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
      value = value << 8U | static_cast<unsigned char>(pcap.at(at + static_cast<std::size_t>(i)));
    return value;
  };
  std::vector<EthernetFrame> frames;
  for (std::size_t at = 24; at < pcap.size(); at += 16 + word(at + 8))
    frames.push_back({word(at), word(at + 4), pcap.substr(at + 16, word(at + 8))});
  return frames;
}

/// How a capture is written.
struct CaptureForm {
  bool is_big = false;
  bool has_nanoseconds = false;
  std::uint16_t link_type = 1;
  /// Makes the packet of that link type.
  std::function<std::string(const std::string& ethernet)> wrapped = [](const std::string& octets) {
    return octets;
  };
};

inline std::string pcap_of(const std::vector<EthernetFrame>& frames, const CaptureForm& form) {
  const auto put = [&](std::uint64_t value, int size) { return number(value, size, form.is_big); };
  std::string file = put(form.has_nanoseconds ? 0xa1b23c4d : 0xa1b2c3d4, 4) + put(2, 2) +
                     put(4, 2) + put(0, 4) + put(0, 4) + put(262144, 4) + put(form.link_type, 4);
  for (const EthernetFrame& frame : frames) {
    const std::string packet = form.wrapped(frame.octets);
    file += put(frame.seconds, 4) +
            put(std::uint64_t{frame.microseconds} * (form.has_nanoseconds ? 1000 : 1), 4) +
            put(packet.size(), 4) + put(packet.size(), 4) + packet;
  }
  return file;
}

/// @param resolution  if_tsresol
inline std::string pcapng_of(const std::vector<EthernetFrame>& frames, const CaptureForm& form,
                             std::uint8_t resolution) {
  const auto put = [&](std::uint64_t value, int size) { return number(value, size, form.is_big); };
  const auto block = [&](std::uint32_t type, std::string body) {
    body.resize((body.size() + 3) / 4 * 4);
    const std::string length = put(body.size() + 12, 4);
    return put(type, 4) + length + body + length;
  };
  std::string file =
      block(0x0a0d0d0a, put(0x1a2b3c4d, 4) + put(1, 2) + put(0, 2) + put(~std::uint64_t{0}, 8));
  std::string options = put(9, 2) + put(1, 2) + std::string(1, static_cast<char>(resolution));
  options.resize(8);
  file += block(1, put(form.link_type, 2) + put(0, 2) + put(0, 4) + options + put(0, 4));
  for (const EthernetFrame& frame : frames) {
    const std::string packet = form.wrapped(frame.octets);
    std::uint64_t units = 0;
    if (resolution >= 0x80) {
      const unsigned bits = resolution & 0x7fU;
      units = (std::uint64_t{frame.seconds} << bits) +
              ((std::uint64_t{frame.microseconds} << bits) + 999'999) / 1'000'000;
    } else {
      units = std::uint64_t{frame.seconds} * 1'000'000 + frame.microseconds;
      for (int i = 6; i < resolution; ++i) units *= 10;
    }
    file += block(6, put(0, 4) + put(units >> 32U, 4) + put(units & 0xffffffffU, 4) +
                         put(packet.size(), 4) + put(packet.size(), 4) + packet);
  }
  return file;
}

/// The samples and flows in one line each, for comparison; instants to the microsecond.
inline std::string summary_of(const Recording& recording) {
  std::string text;
  const auto add = [&text](const std::vector<RecordedSample>& samples) {
    for (const RecordedSample& one : samples)
      text += " " + std::to_string((one.at.count() + 500) / 1000) + ":" + std::to_string(one.bytes);
    text += "\n";
  };
  for (const RecordedTopic& topic : recording.topics) {
    text += topic.name + " " + topic.type;
    add(topic.samples);
  }
  for (const RecordedFlow& flow : recording.flows) {
    text += "port " + std::to_string(flow.port);
    add(flow.datagrams);
  }
  return text;
}

}  // namespace hal::files::recording
