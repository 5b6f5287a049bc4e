#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

// Not nlohmann-json, which the rest of the project uses: it would take 2.0 (frames) to 2.6 (poses)
// times the user time for tiles (tests/bench/json_bench.cpp), and the page requests tiles as fast
// as it can scroll. The other answers of the view are written in the same way, for consistency.

namespace view::server {

/// Text that is JSON already: it is appended as it is.
struct Json {
  std::string text;
};

/// Appends one value to JSON text. Strings become valid UTF-8, whatever they were, and contain no
/// '<', so that text inlined in a page cannot end its script. Numbers read back to the same bits;
/// numbers that are not finite become null.
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

/// Builds a JSON object.
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

/// A JSON array of any range of values: [1,2,3].
template <class Range>
Json json_array(const Range& values) {
  JsonArray array;
  for (const auto& value : values) array.add(value);
  return array.json();
}

}  // namespace view::server
