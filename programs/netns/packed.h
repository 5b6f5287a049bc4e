#pragma once

#include <concepts>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace programs::netns {

/// Serialises values, for two programs of the same build.
class Packer {
 public:
  template <std::integral T>
  void put(T value) {
    const auto wide = static_cast<std::uint64_t>(value);
    bytes_.append(reinterpret_cast<const char*>(&wide), sizeof wide);
  }
  void put(std::string_view text) {
    put(text.size());
    bytes_.append(text);
  }
  void put(const std::vector<std::string>& texts) {
    put(texts.size());
    for (const std::string& text : texts) put(text);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads values back. @throws std::runtime_error  if there are no more bytes.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  template <std::integral T = std::uint64_t>
  T number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return static_cast<T>(value);
  }
  std::string text() { return std::string(take(number<std::size_t>())); }
  std::vector<std::string> texts() {
    std::vector<std::string> all;
    for (auto left = number(); left > 0; --left) all.push_back(text());
    return all;
  }

 private:
  std::string_view take(std::size_t length) {
    if (length > rest_.size()) throw std::runtime_error("a message of the namespaces is cut off");
    const std::string_view taken = rest_.substr(0, length);
    rest_.remove_prefix(length);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace programs::netns
