#include "hal/config/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hal/config/node.h"
#include "hal/config/problems.h"
#include "hal/config/suggest.h"
#include "hal/config/value.h"

namespace hal::config {

using Kind = Node::Kind;

Mapping::Mapping(const Node& node, std::string path, Problems& problems)
    : node_(&node), path_(std::move(path)), problems_(&problems) {}

std::string Mapping::path_of(const std::string& key) const { return joined(path_, key); }

const Entry* Mapping::find(const std::string& key) {
  known_.insert(key);
  return node_->find(key);
}

bool Mapping::has(const std::string& key) { return find(key) != nullptr; }

const Node* Mapping::required(const std::string& key) {
  const Entry* entry = find(key);
  if (entry != nullptr) return &entry->value;
  if (!broken_) problems_->add(node_->place, path_of(key), "is missing");
  return nullptr;
}

const std::string* Mapping::scalar(const Node& node, const std::string& key,
                                   std::string_view expected) {
  if (node.kind == Kind::kScalar) return &node.text;
  problems_->add(node.place, path_of(key),
                 fmt::format("must be {}, not {}", expected, kind_name(node)));
  return nullptr;
}

std::optional<double> Mapping::parsed(const Node& node, const std::string& key,
                                      std::string_view unit, Range range) {
  const std::string expected =
      unit == "1" ? "a plain number" : fmt::format("a number with its unit ({})", unit);
  const std::string* text = scalar(node, key, expected);
  if (text == nullptr) return std::nullopt;
  const auto value = parse_value(*text, unit, range.low, range.high);
  if (value) return *value;
  problems_->add(node.place, path_of(key), value.error().message);
  return std::nullopt;
}

double Mapping::number(const std::string& key, std::string_view unit, Range range) {
  const Node* node = required(key);
  return node == nullptr ? range.low : parsed(*node, key, unit, range).value_or(range.low);
}

double Mapping::number(const std::string& key, std::string_view unit, Range range,
                       double otherwise) {
  const Entry* entry = find(key);
  return entry == nullptr ? otherwise : parsed(entry->value, key, unit, range).value_or(otherwise);
}

std::optional<std::int64_t> Mapping::whole(const Node& node, const std::string& key,
                                           std::int64_t low, std::int64_t high) {
  const std::string* text = scalar(node, key, "a whole number");
  if (text == nullptr) return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  const bool is_whole = end == text->data() + text->size();
  if (!is_whole || error == std::errc::invalid_argument) {
    problems_->add(node.place, path_of(key), fmt::format("'{}' is not a whole number", *text));
    return std::nullopt;
  }
  const bool too_long = error != std::errc{};
  const bool above = too_long ? !text->starts_with('-') : value > high;
  const bool below = too_long ? text->starts_with('-') : value < low;
  if (!above && !below) return value;
  problems_->add(node.place, path_of(key),
                 fmt::format("{} is {} the limit of {}", *text, above ? "above" : "below",
                             above ? high : low));
  return std::nullopt;
}

std::int64_t Mapping::integer(const std::string& key, std::int64_t low, std::int64_t high) {
  const Node* node = required(key);
  return node == nullptr ? low : whole(*node, key, low, high).value_or(low);
}

std::int64_t Mapping::integer(const std::string& key, std::int64_t low, std::int64_t high,
                              std::int64_t otherwise) {
  const Entry* entry = find(key);
  return entry == nullptr ? otherwise : whole(entry->value, key, low, high).value_or(otherwise);
}

Duration Mapping::duration(const std::string& key, Range seconds) {
  return from_seconds(number(key, "s", seconds));
}

Duration Mapping::duration(const std::string& key, Range seconds, Duration otherwise) {
  const Entry* entry = find(key);
  if (entry == nullptr) return otherwise;
  const auto value = parsed(entry->value, key, "s", seconds);
  return value ? from_seconds(*value) : otherwise;
}

std::optional<Duration> Mapping::optional_duration(const std::string& key, double low,
                                                   std::optional<Duration> otherwise) {
  if (!has(key)) return otherwise;
  const double seconds = number(key, "s", {low, kUnlimited});
  if (std::isinf(seconds)) return std::nullopt;
  if (seconds <= kLongestDuration) return from_seconds(seconds);
  mistake(key, fmt::format("must be at most {} s or 'none'", kLongestDuration));
  return std::nullopt;
}

bool Mapping::flag(const std::string& key, bool otherwise) {
  if (!has(key)) return otherwise;
  const Node& node = *required(key);
  const bool plain = node.kind == Kind::kScalar && !node.quoted;
  if (plain && node.text == "true") return true;
  if (plain && node.text == "false") return false;
  problems_->add(node.place, path_of(key), "must be true or false, not " + kind_name(node));
  return otherwise;
}

std::string Mapping::text(const std::string& key) {
  const Node* node = required(key);
  const std::string* text = node == nullptr ? nullptr : scalar(*node, key, "text");
  if (text == nullptr) return "";
  if (text->empty()) problems_->add(node->place, path_of(key), "must not be empty");
  return *text;
}

std::string Mapping::text(const std::string& key, const std::string& otherwise) {
  return has(key) ? text(key) : otherwise;
}

std::vector<double> Mapping::vector(const std::string& key, std::string_view unit, Range range,
                                    std::size_t size) {
  std::vector<double> values(size, range.low);
  const Node* node = required(key);
  if (node == nullptr) return values;
  if (node->kind != Kind::kList || node->items.size() != size) {
    problems_->add(node->place, path_of(key),
                   fmt::format("must be a list of {} values, not {}", size, kind_name(*node)));
    return values;
  }
  for (std::size_t i = 0; i < size; ++i) {
    values[i] = parsed(node->items[i], key, unit, range).value_or(range.low);
  }
  return values;
}

Vec2 Mapping::vec2(const std::string& key, std::string_view unit, Range range) {
  const auto values = vector(key, unit, range, 2);
  return {values[0], values[1]};
}

Vec2 Mapping::vec2(const std::string& key, std::string_view unit, Range range, Vec2 otherwise) {
  return has(key) ? vec2(key, unit, range) : otherwise;
}

Vec3 Mapping::vec3(const std::string& key, std::string_view unit, Range range) {
  const auto values = vector(key, unit, range, 3);
  return {values[0], values[1], values[2]};
}

std::optional<std::size_t> Mapping::chosen(const std::string& key,
                                           const std::vector<std::string>& names) {
  const Node* node = required(key);
  const std::string* text = node == nullptr ? nullptr : scalar(*node, key, "a name");
  if (text == nullptr) return std::nullopt;
  const auto found = std::find(names.begin(), names.end(), *text);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  problems_->add(node->place, path_of(key),
                 fmt::format("'{}' is not one of {}{}", *text, fmt::join(names, ", "),
                             suggestion(*text, names)));
  return std::nullopt;
}

std::vector<Scalar> Mapping::texts(const std::string& key) {
  std::vector<Scalar> result;
  const Entry* entry = find(key);
  if (entry == nullptr) return result;
  if (entry->value.kind != Kind::kList) {
    problems_->add(entry->value.place, path_of(key),
                   "must be a list, not " + kind_name(entry->value));
    return result;
  }
  for (const Node& item : entry->value.items) {
    const std::string* text = scalar(item, key, "text");
    if (text != nullptr) result.push_back({"", *text, item.place.text()});
  }
  return result;
}

Mapping Mapping::inner(const Node& node, const std::string& path) {
  if (node.kind == Kind::kMapping) return {node, path, *problems_};
  Mapping empty{problems_->empty_mapping(node.place), path, *problems_};
  if (node.kind != Kind::kNull) {
    problems_->add(node.place, path, "must be a mapping, not " + kind_name(node));
    empty.broken_ = true;
  }
  return empty;
}

Mapping Mapping::mapping(const std::string& key) {
  const Entry* entry = find(key);
  if (entry != nullptr) return inner(entry->value, path_of(key));
  Mapping absent{problems_->empty_mapping(node_->place), path_of(key), *problems_};
  absent.broken_ = broken_;
  return absent;
}

std::vector<Mapping> Mapping::mappings(const std::string& key) {
  std::vector<Mapping> result;
  const Entry* entry = find(key);
  if (entry == nullptr) return result;
  const Node& list = entry->value;
  if (list.kind == Kind::kList) {
    for (const Node& item : list.items) result.push_back(inner(item, path_of(key)));
  } else if (list.kind != Kind::kNull) {
    problems_->add(list.place, path_of(key), "must be a list, not " + kind_name(list));
  }
  return result;
}

std::vector<std::string> Mapping::keys() const {
  std::vector<std::string> result;
  for (const Entry& entry : node_->entries) result.push_back(entry.key);
  return result;
}

std::vector<Scalar> Mapping::scalars() {
  std::vector<Scalar> result;
  for (const Entry& entry : node_->entries) {
    known_.insert(entry.key);
    const std::string* text = scalar(entry.value, entry.key, "a single value");
    if (text != nullptr) result.push_back({entry.key, *text, entry.value.place.text()});
  }
  return result;
}

std::string Mapping::place(const std::string& key) const {
  const Entry* entry = node_->find(key);
  return entry == nullptr ? place() : entry->value.place.text();
}

std::string Mapping::place() const { return node_->place.text(); }

void Mapping::mistake(const std::string& key, std::string what) {
  const Entry* entry = find(key);
  const Place& place = entry == nullptr ? node_->place : entry->value.place;
  problems_->add(place, path_of(key), std::move(what));
}

void Mapping::warn(const std::string& key, std::string what) {
  const Entry* entry = find(key);
  const Place& place = entry == nullptr ? node_->place : entry->value.place;
  problems_->warn(place, path_of(key), std::move(what));
}

void Mapping::refuse(const std::string& key, const std::string& why) {
  const Entry* entry = find(key);
  if (entry != nullptr) problems_->add(entry->place, path_of(key), why);
}

void Mapping::finish() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const Entry& entry : node_->entries) {
    if (known_.contains(entry.key)) continue;
    problems_->add(entry.place, path_of(entry.key),
                   "is not a known key" + suggestion(entry.key, known));
  }
}

}  // namespace hal::config
