#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

// Not nlohmann-json, which the rest of the project uses: tiles, for which the page asks as fast as
// it can scroll, would take 2.0 (frames) to 2.6 (poses) times the user time
// (tests/bench/json_bench.cpp). The little else that the view tells is written by the same means.

namespace view::server {

/// JSON that is already text: goes in as it is.
struct Json {
  std::string text;
};

/// Appends one value to JSON text. Strings are valid UTF-8 afterwards, whatever they were, and hold
/// no '<': what is inlined in a page cannot end its script. Numbers read back to the same bits;
/// what is not finite is null.
void append_json(std::string& to, std::string_view text);
void append_json(std::string& to, double number);
void append_json(std::string& to, std::int64_t number);
inline void append_json(std::string& to, const std::string& text) {
  append_json(to, std::string_view(text));
}
inline void append_json(std::string& to, const char* text) {
  append_json(to, std::string_view(text));
}
inline void append_json(std::string& to, std::nullopt_t) { to += "null"; }
inline void append_json(std::string& to, const Json& json) { to += json.text; }
template <class Integer>
requires std::is_integral_v<Integer>
void append_json(std::string& to, Integer number) {
  if constexpr (std::is_same_v<Integer, bool>) {
    to += number ? "true" : "false";
  } else {
    append_json(to, static_cast<std::int64_t>(number));
  }
}
template <class T>
void append_json(std::string& to, const std::optional<T>& value) {
  value ? append_json(to, *value) : append_json(to, std::nullopt);
}

/// A JSON object or array that grows.
///
///   JsonObject agent;
///   agent.add("name", "r0").add("x", 1.5);
///   use(agent.json().text);   // {"name":"r0","x":1.5}
class JsonObject {
 public:
  template <class Value>
  JsonObject& add(std::string_view key, const Value& value) {
    if (text_.size() > 1) text_ += ',';
    append_json(text_, key);
    text_ += ':';
    append_json(text_, value);
    return *this;
  }
  Json json() const { return {text_ + '}'}; }

 private:
  std::string text_ = "{";
};

class JsonArray {
 public:
  template <class Value>
  JsonArray& add(const Value& value) {
    if (text_.size() > 1) text_ += ',';
    append_json(text_, value);
    return *this;
  }
  bool empty() const { return text_.size() == 1; }
  Json json() const { return {text_ + ']'}; }

 private:
  std::string text_ = "[";
};

/// [1,2,3] of any range of values.
template <class Range>
Json json_array(const Range& values) {
  JsonArray array;
  for (const auto& value : values) array.add(value);
  return array.json();
}

}  // namespace view::server
