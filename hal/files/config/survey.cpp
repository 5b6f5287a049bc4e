#include "hal/files/config/survey.h"

#include <algorithm>
#include <deque>
#include <iterator>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace hal::files::config {

Mapping Survey::root() { return {problems_.empty_mapping({}), "", problems_, this}; }

void Survey::note(const std::string& path, const Key& key, Form form, std::string otherwise) {
  if (known_ != nullptr && known_->contains(path)) return;
  if (!places_.try_emplace(path, read_.size()).second) return;  // a value that two calls read
  if (!key.otherwise.empty()) otherwise = key.otherwise;
  read_.push_back({path, std::string(key.meaning), std::string(key.example), std::move(form),
                   std::move(otherwise)});
}

const Survey::Read* Survey::at(const std::string& path) const {
  const auto place = places_.find(path);
  return place == places_.end() ? nullptr : &read_[place->second];
}

std::size_t Survey::decide(Decision decision) {
  const auto [met, is_new] = met_.try_emplace(decision.id(), decisions_.size());
  if (!is_new) return decisions_[met->second].taken;
  if (const auto wanted = taken_.find(met->first); wanted != taken_.end())
    decision.taken = wanted->second;
  decisions_.push_back(std::move(decision));
  return decisions_.back().taken;
}

namespace {

/// Calls a reader on every way and compares what it read.
class Explorer {
 public:
  explicit Explorer(const std::function<void(Mapping)>& read) : read_(read) {}

  KeyTable table();
  std::set<std::string> top_level_keys();

 private:
  /// One way: the options that differ from those taken by itself, and the keys and decisions first
  /// found on it.
  struct Way {
    Taken taken;
    std::vector<const Survey::Read*> found;
    std::vector<const Decision*> met;
  };

  void survey_with(Survey& survey);
  const Survey& survey_of(const Taken& taken);
  /// @pre `decision` is one of survey_of(taken).
  const Survey& survey_where(const Taken& taken, const Decision& decision, std::size_t option);
  void follow(const Taken& taken);
  void follow_all() {
    for (; !ahead_.empty(); ahead_.pop_front()) follow(ahead_.front());
  }
  void find_far();
  /// Ways that take one more decision otherwise.
  std::vector<Taken> pairs(const Taken& taken);
  void add_new(const Taken& pair, std::vector<KeyDescription>& keys);
  KeyDescription described(const Survey::Read& key, const Taken& taken);
  std::optional<Condition> condition(const std::string& path, const Taken& taken,
                                     const Decision& decision, KeyDescription& key);
  bool reaches_out(const Taken& taken, const Decision& decision);
  std::vector<std::string> never_read() const;

  const std::function<void(Mapping)>& read_;
  std::map<Taken, Survey> surveys_;
  std::deque<Taken> ahead_{{}};
  std::vector<Way> ways_;
  /// Decisions, by Decision::id(), and those of them that keys outside their mapping hang on.
  std::set<std::string> decisions_, far_;
  std::unordered_set<std::string> paths_;
  std::set<std::string> mentioned_;
};

void Explorer::survey_with(Survey& survey) {
  read_(survey.root());
  mentioned_.insert(survey.mentioned().begin(), survey.mentioned().end());
}

const Survey& Explorer::survey_of(const Taken& taken) {
  const auto [found, is_new] = surveys_.try_emplace(taken, taken);
  if (is_new) survey_with(found->second);
  return found->second;
}

Taken taking(Taken taken, const Decision& decision, std::size_t option) {
  taken[decision.id()] = option;
  return taken;
}

/// What is taken anyway need not be wanted.
const Survey& Explorer::survey_where(const Taken& taken, const Decision& decision,
                                     std::size_t option) {
  return survey_of(option == decision.taken ? taken : taking(taken, decision, option));
}

void Explorer::follow(const Taken& taken) {
  const Survey& survey = survey_of(taken);
  Way way{taken, {}, {}};
  for (const Survey::Read& read : survey.read()) {
    if (paths_.insert(read.path).second) way.found.push_back(&read);
  }
  for (const Decision& decision : survey.decisions()) {
    if (!decisions_.insert(decision.id()).second) continue;
    way.met.push_back(&decision);
    for (std::size_t option = 0; option < decision.options.size(); ++option) {
      if (option != decision.taken) ahead_.push_back(taking(taken, decision, option));
    }
  }
  ways_.push_back(std::move(way));
}

/// "agents.NAME." of "agents.NAME.radio?".
std::string_view mapping_of(std::string_view id) { return id.substr(0, id.rfind('.') + 1); }

/// Whether one of two decisions stands in the mapping of the other, or in one inside it: then keys
/// may hang on both.
bool may_meet(std::string_view one, std::string_view other) {
  return one.starts_with(mapping_of(other)) || other.starts_with(mapping_of(one));
}

std::vector<Taken> Explorer::pairs(const Taken& taken) {
  std::vector<Taken> result;
  for (const Decision& decision : survey_of(taken).decisions()) {
    if (taken.contains(decision.id())) continue;
    const std::string id = decision.id();
    const bool meets = taken.empty() || std::ranges::any_of(taken, [&](const auto& one) {
                         return may_meet(one.first, id);
                       });
    if (!meets) continue;
    for (std::size_t option = 0; option < decision.options.size(); ++option) {
      if (option != decision.taken) result.push_back(taking(taken, decision, option));
    }
  }
  return result;
}

/// Whether the path lies in, or is, the key whose presence was asked for.
bool lies_in(const std::string& path, const std::string& key) {
  return path == key || path.starts_with(key + ".") || path.starts_with(key + "[");
}

std::optional<Condition> Explorer::condition(const std::string& path, const Taken& taken,
                                             const Decision& decision, KeyDescription& key) {
  Condition condition{decision.path, decision.presence, {}};
  std::vector<KeyDescription::Variant> variants;
  for (std::size_t option = 0; option < decision.options.size(); ++option) {
    const Survey::Read* read = survey_where(taken, decision, option).at(path);
    if (read == nullptr) continue;
    condition.values.push_back(decision.options[option]);
    variants.push_back({decision.options[option], read->otherwise, limits(read->form)});
  }
  const bool differ = std::any_of(variants.begin(), variants.end(), [&](const auto& other) {
    return other.otherwise != variants.front().otherwise || other.limits != variants.front().limits;
  });
  if (differ) key.variants = std::move(variants);
  if (condition.values.size() == decision.options.size()) return std::nullopt;
  if (!decision.presence || !lies_in(path, decision.path)) return condition;
  if (path == decision.path) key.optional = true;  // it is there when it is there
  return std::nullopt;
}

/// Whether a key outside the mapping of the decision is read otherwise, or not, when it is taken
/// otherwise.
bool Explorer::reaches_out(const Taken& taken, const Decision& decision) {
  const Survey& survey = survey_of(taken);
  const std::string_view mapping = mapping_of(decision.path);
  const auto is_other = [&](const Survey::Read& read, const Survey& in) {
    if (read.path.starts_with(mapping)) return false;
    const Survey::Read* there = in.at(read.path);
    return there == nullptr || there->otherwise != read.otherwise ||
           limits(there->form) != limits(read.form);
  };
  for (std::size_t option = 0; option < decision.options.size(); ++option) {
    const Survey& other = survey_where(taken, decision, option);
    const auto differs = [&](const Survey& one, const Survey& in) {
      return std::ranges::any_of(one.read(), [&](const auto& read) { return is_other(read, in); });
    };
    if (differs(survey, other) || differs(other, survey)) return true;
  }
  return false;
}

void Explorer::find_far() {
  for (const Way& way : ways_) {
    for (const Decision* decision : way.met) {
      if (reaches_out(way.taken, *decision)) far_.insert(decision->id());
    }
  }
}

KeyDescription Explorer::described(const Survey::Read& read, const Taken& taken) {
  KeyDescription key{.path = read.path,
                     .meaning = read.meaning,
                     .example = read.example,
                     .form = read.form,
                     .optional = false,
                     .variants = {{"", read.otherwise, limits(read.form)}},
                     .conditions = {}};
  for (const Decision& decision : survey_of(taken).decisions()) {
    if (!may_meet(decision.path, read.path) && !far_.contains(decision.id())) continue;
    if (auto one = condition(read.path, taken, decision, key)) {
      key.conditions.push_back(std::move(*one));
    }
  }
  // The value says that it is there.
  const std::vector<Condition> all = key.conditions;
  std::erase_if(key.conditions, [&](const Condition& one) {
    return one.presence && std::any_of(all.begin(), all.end(), [&](const Condition& other) {
             return !other.presence && other.path == one.path;
           });
  });
  return key;
}

std::vector<std::string> Explorer::never_read() const {
  std::vector<std::string> result;
  std::ranges::copy_if(mentioned_, std::back_inserter(result),
                       [&](const std::string& path) { return !paths_.contains(path); });
  return result;
}

std::string outer_path(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

bool operator==(const Condition& a, const Condition& b) {
  return a.path == b.path && a.presence == b.presence && a.values == b.values;
}

/// What holds for a mapping holds for its keys: it need not be said again.
void drop_inherited(std::vector<KeyDescription>& keys) {
  std::map<std::string, std::vector<Condition>> all;
  for (KeyDescription& key : keys) {
    all[key.path] = key.conditions;
    std::string outer = outer_path(key.path);
    if (outer.ends_with("[]")) outer.resize(outer.size() - 2);
    const std::vector<Condition>& known = all[outer];
    std::erase_if(key.conditions, [&](const Condition& condition) {
      return std::any_of(known.begin(), known.end(),
                         [&](const Condition& other) { return other == condition; });
    });
  }
}

/// Keys by the mapping they are in.
using ByMapping = std::map<std::string, std::vector<KeyDescription>>;

void append_keys_of(const std::string& mapping, ByMapping& all, std::vector<KeyDescription>& out) {
  const auto found = all.find(mapping);
  if (found == all.end()) return;
  const std::vector<KeyDescription> keys = std::exchange(found->second, {});
  out.insert(out.end(), keys.begin(), keys.end());
  for (const KeyDescription& key : keys) {
    append_keys_of(key.path, all, out);
    append_keys_of(key.path + "[]", all, out);
  }
}

/// Each mapping's keys together, then those of the mappings in it.
std::vector<KeyDescription> in_order(const std::vector<KeyDescription>& keys) {
  ByMapping all;
  for (const KeyDescription& key : keys) all[outer_path(key.path)].push_back(key);
  std::vector<KeyDescription> result;
  append_keys_of("", all, result);
  return result;
}

/// The keys that are read on this way and were on none before.
void Explorer::add_new(const Taken& pair, std::vector<KeyDescription>& keys) {
  // A survey that is new is not kept: there are thousands.
  const auto kept = surveys_.find(pair);
  std::optional<Survey> passing;
  if (kept == surveys_.end()) survey_with(passing.emplace(pair, &paths_));
  const Survey& survey = passing ? *passing : kept->second;
  for (const Survey::Read& read : survey.read()) {
    if (paths_.insert(read.path).second) keys.push_back(described(read, pair));
  }
}

KeyTable Explorer::table() {
  KeyTable table;
  follow_all();
  find_far();
  for (const Way& way : ways_) {
    for (const Survey::Read* read : way.found) table.keys.push_back(described(*read, way.taken));
  }
  std::set<Taken> known;
  for (const Way& way : ways_) {
    for (const Taken& pair : pairs(way.taken)) {
      if (known.insert(pair).second) add_new(pair, table.keys);
    }
  }
  table.keys = in_order(table.keys);
  drop_inherited(table.keys);
  table.never_read = never_read();
  return table;
}

std::set<std::string> Explorer::top_level_keys() {
  follow_all();
  std::set<std::string> keys(paths_.begin(), paths_.end());
  std::erase_if(
      keys, [](const std::string& path) { return path.find_first_of(".[") != std::string::npos; });
  return keys;
}

}  // namespace

KeyTable survey(const std::function<void(Mapping)>& read) { return Explorer(read).table(); }

std::set<std::string> top_level_keys(const std::function<void(Mapping)>& read) {
  return Explorer(read).top_level_keys();
}

}  // namespace hal::files::config
