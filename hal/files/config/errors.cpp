#include "hal/files/config/errors.h"

#include <fmt/format.h>

#include <utility>

#include "hal/files/config/document_limits.h"

namespace hal::files::config {

namespace {

/// Removes the middle of a text longer than `most`.
void shorten(std::string& text, std::size_t most) {
  if (text.size() <= most) return;
  const std::string cut = fmt::format("...({} bytes)...", text.size());
  text.replace(most / 2, text.size() - most, cut);
}

/// Makes a message fit for terminals: no control characters, no overlong words or lines.
std::string presentable(const std::string& message) {
  std::string result;
  std::string word;
  const auto end_word = [&] {
    shorten(word, kLongestWord);
    result += word;
    word.clear();
  };
  for (const char c : message) {
    if (c == ' ') {
      end_word();
      result += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    word += byte < 0x20 || byte == 0x7f ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  end_word();
  shorten(result, kLongestMessage);
  return result;
}

/// Makes the messages presentable and joins them into one text.
std::string presented(std::vector<std::string>& messages) {
  const std::size_t count = messages.size();
  if (count > kMostMessages) messages.resize(kMostMessages);
  for (std::string& message : messages) message = presentable(message);
  if (count > kMostMessages) {
    messages.push_back(fmt::format("and {} more mistakes", count - kMostMessages));
  }
  return fmt::format("{}", fmt::join(messages, "\n"));
}

}  // namespace

ConfigErrors::ConfigErrors(std::vector<std::string> messages)
    : std::runtime_error(presented(messages)), messages_(std::move(messages)) {}

}  // namespace hal::files::config
