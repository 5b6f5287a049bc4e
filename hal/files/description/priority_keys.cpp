#include "hal/files/description/priority_keys.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "hal/types/message.h"

namespace hal::files::description {
namespace {

/// The first name of a priority is the one that is written.
constexpr std::array<Option<Priority>, 12> kNames{{{"best_effort", Priority::kBestEffort},
                                                   {"background", Priority::kBackground},
                                                   {"video", Priority::kVideo},
                                                   {"voice", Priority::kVoice},
                                                   {"0", Priority{0}},
                                                   {"1", Priority{1}},
                                                   {"2", Priority{2}},
                                                   {"3", Priority{3}},
                                                   {"4", Priority{4}},
                                                   {"5", Priority{5}},
                                                   {"6", Priority{6}},
                                                   {"7", Priority{7}}}};

std::string name_of(Priority priority) {
  const auto* const found = std::ranges::find(kNames, priority, &Option<Priority>::value);
  BARAKA_CHECK(found != kNames.end());
  return std::string(found->name);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  names.reserve(kNames.size());
  for (const auto& one : kNames) names.emplace_back(one.name);
  return names;
}

void read_priorities(Mapping in, std::map<std::string, Priority, std::less<>>& priorities) {
  for (const std::string& topic : in.keys()) {
    const auto index = in.choice(Key(topic, "Priority of this topic."), all_names());
    if (topic.size() > kMaxTopic) {
      in.mistake(topic,
                 fmt::format("has {} bytes, a topic has at most {}", topic.size(), kMaxTopic));
    } else if (index) {
      priorities[topic] = kNames[*index].value;
    }
  }
}

}  // namespace

void priorities_key(Fields& io, std::map<std::string, Priority, std::less<>>& priorities) {
  const Key key{
      "priorities",
      "Priorities of messages by topic, which replace those that controllers give them: a user "
      "priority of 802.11, 0 to 7, or best_effort (0), background (1), video (5) or voice (6). "
      "With `qos` of the radio they select the access category; a real robot marks its datagrams "
      "with the DSCP CS0 to CS7.",
      "{alarm: voice, images: 1}", "as controllers send them"};
  io.written_if(!priorities.empty(), [&](Fields& given) {
    given.own(
        key, {.kind = Form::Kind::kMapping},
        [&](Mapping& in) {
          if (in.has(key.name)) read_priorities(in.mapping(key), priorities);
        },
        [&](Writer& out) {
          out.open(key.name);
          for (const auto& [topic, priority] : priorities) out.text(topic, name_of(priority));
          out.close();
        });
  });
}

void priority_key(Fields& io, const Key& key, Priority& priority) {
  io.choice(key, kNames, priority);
}

}  // namespace hal::files::description
