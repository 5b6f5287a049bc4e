#include "hal/files/config/mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "hal/files/config/list_edit.h"
#include "hal/files/config/node.h"
#include "hal/files/config/problems.h"
#include "hal/files/config/suggest.h"
#include "hal/files/config/value.h"
#include "hal/files/config/writer.h"
#include "hal/files/config/yaml.h"

namespace hal::files::config {

using Kind = Node::Kind;

namespace {

Form number_form(std::string_view unit, Range range) {
  return {.kind = Form::Kind::kNumber, .unit = unit, .range = range};
}

Form whole_form(std::int64_t low, std::int64_t high) {
  return {.kind = Form::Kind::kWhole, .low = low, .high = high};
}

WrittenValue written_value(const Node& node) {
  std::string yaml = flow_yaml(node);
  return {node.kind == Kind::kScalar ? node.text : yaml, yaml, node.place.text()};
}

Form vector_form(std::string_view unit, Range range, std::size_t size) {
  return {.kind = Form::Kind::kVector, .unit = unit, .range = range, .size = size};
}

}  // namespace

Mapping::Mapping(const Node& node, std::string path, Problems& problems)
    : node_(&node), path_(std::move(path)), problems_(&problems) {}

std::string Mapping::path_of(const std::string& key) const { return joined(path_, key); }

const Entry* Mapping::find(const std::string& key) {
  if (known_.insert(key).second) order_.push_back(key);
  return node_->find(key);
}

bool Mapping::has(const std::string& key) { return find(key) != nullptr; }

bool Mapping::has_scalar(const std::string& key) {
  const Entry* entry = find(key);
  return entry != nullptr && entry->value.kind == Kind::kScalar;
}

bool Mapping::has_mapping(const std::string& key) {
  const Entry* entry = find(key);
  return entry != nullptr && entry->value.kind == Kind::kMapping;
}

const Node* Mapping::required(const Key& key, const Form& form) {
  const Entry* entry = find(key.name);
  if (entry != nullptr) return &entry->value;
  if (!broken_) problems_->add(node_->place, path_of(key.name), missing(key, form));
  return nullptr;
}

const std::string* Mapping::scalar(const Node& node, const std::string& key,
                                   std::string_view expected) {
  if (node.kind == Kind::kScalar) return &node.text;
  problems_->add(node.place, path_of(key),
                 fmt::format("must be {}, not {}", expected, kind_name(node)));
  return nullptr;
}

std::optional<double> Mapping::parsed(const Node& node, const Key& key, const Form& form) {
  const std::string* text = scalar(node, key.name, expected(number_form(form.unit, form.range)));
  if (text == nullptr) return std::nullopt;
  const auto value = parse_value(*text, form.unit, form.range.low, form.range.high);
  if (value) return *value;
  problems_->add(node.place, path_of(key.name), value.error().message);
  return std::nullopt;
}

double Mapping::number(const Key& key, std::string_view unit, Range range) {
  const Form form = number_form(unit, range);
  const Node* node = required(key, form);
  return node == nullptr ? range.low : parsed(*node, key, form).value_or(range.low);
}

double Mapping::number(const Key& key, std::string_view unit, Range range, double otherwise) {
  const Form form = number_form(unit, range);
  const Entry* entry = find(key.name);
  return entry == nullptr ? otherwise : parsed(entry->value, key, form).value_or(otherwise);
}

std::optional<std::int64_t> Mapping::whole(const Node& node, const Key& key, const Form& form) {
  const std::string* text = scalar(node, key.name, expected(form));
  if (text == nullptr) return std::nullopt;
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  const bool is_whole = end == text->data() + text->size();
  if (!is_whole || error == std::errc::invalid_argument) {
    problems_->add(node.place, path_of(key.name), fmt::format("'{}' is not a whole number", *text));
    return std::nullopt;
  }
  const bool too_long = error != std::errc{};
  const bool above = too_long ? !text->starts_with('-') : value > form.high;
  const bool below = too_long ? text->starts_with('-') : value < form.low;
  if (!above && !below) return value;
  problems_->add(node.place, path_of(key.name),
                 fmt::format("{} is {} the limit of {}", *text, above ? "above" : "below",
                             above ? form.high : form.low));
  return std::nullopt;
}

std::int64_t Mapping::integer(const Key& key, std::int64_t low, std::int64_t high) {
  const Form form = whole_form(low, high);
  const Node* node = required(key, form);
  return node == nullptr ? low : whole(*node, key, form).value_or(low);
}

std::int64_t Mapping::integer(const Key& key, std::int64_t low, std::int64_t high,
                              std::int64_t otherwise) {
  const Form form = whole_form(low, high);
  const Entry* entry = find(key.name);
  return entry == nullptr ? otherwise : whole(entry->value, key, form).value_or(otherwise);
}

Duration Mapping::duration(const Key& key, Range seconds) {
  return from_seconds(number(key, "s", seconds));
}

Duration Mapping::duration(const Key& key, Range seconds, Duration otherwise) {
  const Form form = number_form("s", seconds);
  const Entry* entry = find(key.name);
  if (entry == nullptr) return otherwise;
  const auto value = parsed(entry->value, key, form);
  return value ? from_seconds(*value) : otherwise;
}

std::optional<Duration> Mapping::optional_duration(const Key& key, double low,
                                                   std::optional<Duration> otherwise) {
  const Form form = number_form("s", {low, kUnlimited});
  const Entry* entry = find(key.name);
  if (entry == nullptr) return otherwise;
  const double seconds = parsed(entry->value, key, form).value_or(low);
  if (std::isinf(seconds)) return std::nullopt;
  if (seconds <= kLongestDuration) return from_seconds(seconds);
  mistake(key.name, fmt::format("must be at most {} s or 'none'", kLongestDuration));
  return std::nullopt;
}

bool Mapping::flag(const Key& key, bool otherwise) {
  const Form form{.kind = Form::Kind::kFlag};
  const Entry* entry = find(key.name);
  if (entry == nullptr) return otherwise;
  const Node& node = entry->value;
  const bool plain = node.kind == Kind::kScalar && !node.quoted;
  if (plain && node.text == "true") return true;
  if (plain && node.text == "false") return false;
  problems_->add(node.place, path_of(key.name),
                 fmt::format("must be {}, not {}", expected(form), kind_name(node)));
  return otherwise;
}

std::string Mapping::text(const Key& key) {
  const Form form{.kind = Form::Kind::kText};
  const Node* node = required(key, form);
  const std::string* text = node == nullptr ? nullptr : scalar(*node, key.name, expected(form));
  if (text == nullptr) return "";
  if (text->empty()) problems_->add(node->place, path_of(key.name), "must not be empty");
  return *text;
}

std::string Mapping::text(const Key& key, const std::string& otherwise) {
  if (find(key.name) == nullptr) return otherwise;
  return text(key);
}

std::vector<double> Mapping::vector(const Key& key, const Form& form, const Node* node) {
  std::vector<double> values(form.size, form.range.low);
  if (node == nullptr) return values;
  if (node->kind != Kind::kList || node->items.size() != form.size) {
    problems_->add(
        node->place, path_of(key.name),
        fmt::format("must be a list of {} values, {}, not {}", form.size,
                    key.example.empty() ? expected(form) : fmt::format("e.g. {}", key.example),
                    kind_name(*node)));
    return values;
  }
  for (std::size_t i = 0; i < form.size; ++i) {
    values[i] = parsed(node->items[i], key, form).value_or(form.range.low);
  }
  return values;
}

Vec2 Mapping::vec2(const Key& key, std::string_view unit, Range range) {
  const Form form = vector_form(unit, range, 2);
  const auto values = vector(key, form, required(key, form));
  return {values[0], values[1]};
}

Vec2 Mapping::vec2(const Key& key, std::string_view unit, Range range, Vec2 otherwise) {
  const Form form = vector_form(unit, range, 2);
  const Entry* entry = find(key.name);
  if (entry == nullptr) return otherwise;
  const auto values = vector(key, form, &entry->value);
  return {values[0], values[1]};
}

Vec3 Mapping::vec3(const Key& key, std::string_view unit, Range range) {
  const Form form = vector_form(unit, range, 3);
  const auto values = vector(key, form, required(key, form));
  return {values[0], values[1], values[2]};
}

std::optional<std::size_t> Mapping::chosen(const Key& key, std::vector<std::string> names,
                                           std::optional<std::size_t> otherwise) {
  const Form form{.kind = Form::Kind::kChoice, .options = std::move(names)};
  const Entry* entry = find(key.name);
  if (otherwise && entry == nullptr) return std::nullopt;
  const Node* node = required(key, form);
  const std::string* text = node == nullptr ? nullptr : scalar(*node, key.name, "a name");
  if (text == nullptr) return std::nullopt;
  const auto found = std::find(form.options.begin(), form.options.end(), *text);
  if (found != form.options.end()) return static_cast<std::size_t>(found - form.options.begin());
  problems_->add(
      node->place, path_of(key.name),
      fmt::format("'{}' is not {}{}", *text, expected(form), suggestion(*text, form.options)));
  return std::nullopt;
}

std::vector<Scalar> Mapping::texts(const Key& key) {
  std::vector<Scalar> result;
  const Entry* entry = find(key.name);
  if (entry == nullptr) return result;
  if (entry->value.kind != Kind::kList) {
    problems_->add(entry->value.place, path_of(key.name),
                   "must be a list, not " + kind_name(entry->value));
    return result;
  }
  for (const Node& item : entry->value.items) {
    const std::string* text = scalar(item, key.name, "text");
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

Mapping Mapping::inner_of(const std::string& key) {
  const Entry* entry = find(key);
  if (entry != nullptr) return inner(entry->value, path_of(key));
  Mapping absent{problems_->empty_mapping(node_->place), path_of(key), *problems_};
  absent.broken_ = broken_;
  return absent;
}

std::vector<Mapping> Mapping::inner_list(const std::string& key) {
  std::vector<Mapping> result;
  const Entry* entry = find(key);
  if (entry == nullptr) return result;
  const Node& list = entry->value;
  if (list.kind == Kind::kList) {
    for (const Node& item : list.items) result.push_back(inner(item, path_of(key)));
  } else if (is_list_edit(list)) {  // no included file has the list
    const Entry* const added = list.find("add");
    if (added != nullptr && added->value.kind == Kind::kList) {
      for (const Node& item : added->value.items) result.push_back(inner(item, path_of(key)));
    }
    for (const Entry& left : edited({}, list).entries)
      problems_->add(left.place, path_of(key), list_mistake({}, left));
  } else if (list.kind != Kind::kNull) {
    problems_->add(list.place, path_of(key), "must be a list, not " + kind_name(list));
  }
  return result;
}

Mapping Mapping::mapping(const Key& key) { return inner_of(key.name); }

std::vector<Mapping> Mapping::mappings(const Key& key) { return inner_list(key.name); }

Mapping Mapping::within(const std::string& key) { return inner_of(key); }

std::vector<Mapping> Mapping::items(const std::string& key) { return inner_list(key); }

std::vector<std::string> Mapping::keys() const {
  std::vector<std::string> result;
  for (const Entry& entry : node_->entries) result.push_back(entry.key);
  return result;
}

std::optional<PlainValue> Mapping::plain_value(const Node& node, const std::string& key,
                                               std::string_view expected) {
  PlainValue value{.key = key, .text = {}, .place = node.place.text()};
  value.is_list = node.kind == Kind::kList;
  bool is_plain = true;
  for (const Node& item : node.items) {
    const std::string* text = scalar(item, key, "a single value");
    is_plain = is_plain && text != nullptr;
    if (is_plain) value.items.push_back(*text);
  }
  if (!value.is_list) {
    const std::string* text = scalar(node, key, expected);
    is_plain = text != nullptr;
    if (is_plain) value.text = *text;
  }
  if (!is_plain) return std::nullopt;
  return value;
}

std::vector<PlainValue> Mapping::plain_values() {
  std::vector<PlainValue> result;
  for (const Entry& entry : node_->entries) {
    find(entry.key);
    auto value = plain_value(entry.value, entry.key, "a single value or a list of them");
    if (value) result.push_back(std::move(*value));
  }
  return result;
}

std::vector<PlainValue> Mapping::nested_values() {
  for (const Entry& entry : node_->entries) find(entry.key);
  std::vector<PlainValue> result;
  add_nested(*node_, "", result);
  return result;
}

void Mapping::add_nested(const Node& mapping, const std::string& prefix,
                         std::vector<PlainValue>& values) {
  for (const Entry& entry : mapping.entries) {
    const std::string key = prefix + entry.key;
    if (entry.value.kind == Kind::kMapping) {
      add_nested(entry.value, key + ".", values);
      continue;
    }
    auto value = plain_value(entry.value, key, "a single value, or a list or mapping of them");
    if (value) values.push_back(std::move(*value));
  }
}

std::vector<WrittenEntry> Mapping::written_values() {
  std::vector<WrittenEntry> result;
  for (const Entry& entry : node_->entries) {
    find(entry.key);
    WrittenEntry& written = result.emplace_back();
    written.key = entry.key;
    written.value = written_value(entry.value);
    written.is_list = entry.value.kind == Kind::kList;
    for (const Node& item : entry.value.items) written.items.push_back(written_value(item));
  }
  return result;
}

std::string Mapping::place(const std::string& key) const {
  const Entry* entry = node_->find(key);
  return entry == nullptr ? place() : entry->value.place.text();
}

std::string Mapping::place() const { return node_->place.text(); }

void Mapping::mistake(const std::string& key, std::string what) {
  known_.insert(key);
  const Entry* entry = node_->find(key);
  const Place& place = entry == nullptr ? node_->place : entry->value.place;
  problems_->add(place, path_of(key), std::move(what));
}

void Mapping::warn(const std::string& key, std::string what) {
  const Entry* entry = find(key);
  const Place& place = entry == nullptr ? node_->place : entry->value.place;
  problems_->warn(place, path_of(key), std::move(what));
}

void Mapping::refuse(const std::string& key, const std::string& why) {
  known_.insert(key);  // but not listed in order_
  const Entry* entry = node_->find(key);
  if (entry != nullptr) problems_->add(entry->place, path_of(key), why);
}

void Mapping::finish() {
  if (leaves_rest_) return;
  for (const Entry& entry : node_->entries) {
    if (known_.contains(entry.key)) continue;
    const std::string meant = suggestion(entry.key, order_);
    const std::string others =
        order_.empty()
            ? "; no key is allowed here"
            : fmt::format("{}nown here: {}", meant.empty() ? "; k" : " K", fmt::join(order_, ", "));
    problems_->add(entry.place, path_of(entry.key),
                   fmt::format("is not a known key{}{}", meant, others));
  }
}

}  // namespace hal::files::config
