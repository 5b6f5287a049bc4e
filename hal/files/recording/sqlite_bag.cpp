#include "hal/files/recording/sqlite_bag.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string_view>

#include "hal/files/recording/message_size.h"
#include "hal/files/recording/sqlite_query.h"
#include "hal/types/printable.h"

namespace hal::files::recording {
namespace {

constexpr std::string_view kMagic16("SQLite format 3\0", 16);

/// SQLite itself notices a missing page only when it needs it.
/// @throws std::runtime_error
void check_size(const std::filesystem::path& path, const std::string& name) {
  const MappedFile file(path);
  const Octets octets = file.octets();
  constexpr std::size_t kHeader = 100;
  if (octets.size() < kHeader)
    throw std::runtime_error(
        fmt::format("{}: byte {}: the file ends within the header of SQLite of {} bytes", name,
                    octets.size(), kHeader));
  const auto number = [octets](std::size_t at) {
    return rtps::Cursor(octets.subspan(at), rtps::Endianness::kBig).u32();
  };
  const std::uint32_t told = number(16) >> 16U;
  const std::uint64_t page = told == 1 ? 65536 : told;
  constexpr std::size_t kChangeCounter = 24, kPages = 28, kValidFor = 92;
  if (number(kChangeCounter) != number(kValidFor)) return;  // the number of pages is not told
  const std::uint64_t size = page * number(kPages);
  if (octets.size() < size)
    throw std::runtime_error(fmt::format(
        "{}: byte {}: the file ends; its header tells of {} pages, {} bytes: it is cut off", name,
        octets.size(), number(kPages), size));
}

struct BagTopic {
  std::size_t number = 0;
  std::string name;
};
using BagTopics = std::map<std::int64_t, BagTopic>;

BagTopics read_topics(SqliteFile& file, Collector& into) {
  file.require_table("topics");
  const bool has_qos = file.has_column("topics", "offered_qos_profiles");
  SqliteQuery query(file, "topics",
                    fmt::format("id, name, type, serialization_format, {} FROM topics",
                                has_qos ? "offered_qos_profiles" : "''"));
  BagTopics topics;
  std::map<std::string, int> others;
  while (query.next()) {
    const std::string name = printable(query.text(2)), format = query.text(4);
    std::optional<OfferedQos> offered;
    try {
      offered = read_offered_qos(query.text(5));
    } catch (const std::runtime_error& e) {
      query.fail(fmt::format("topic {}: {}", name, e.what()));
    }
    if (format != "cdr") ++others[printable(format)];
    const std::size_t number = into.topic(dds_name(name), printable(query.text(3)), offered);
    topics[query.integer(1)] = {number, name};
  }
  for (const auto& [format, count] : others) {
    into.note(
        fmt::format("{} topic{} serialised as '{}', not as CDR: the sizes are those in the "
                    "file, without an encapsulation header",
                    count, count == 1 ? " is" : "s are", format));
  }
  return topics;
}

void read_messages(SqliteFile& file, const BagTopics& topics, Collector& into) {
  file.require_table("messages");
  SqliteQuery query(file, "messages", "topic_id, timestamp, data FROM messages");
  while (query.next()) {
    const auto topic = topics.find(query.integer(1));
    if (topic == topics.end())
      query.fail(fmt::format("there is no topic with the id {}", query.integer(1)));
    const std::int64_t at = query.integer(2);
    if (at < 0) query.fail(fmt::format("its timestamp is {} ns", at));
    try {
      into.add(topic->second.number, at, message_size(query.blob(3)));
    } catch (const std::runtime_error& e) {
      const std::string_view what(e.what());
      if (what.find("row ") != std::string_view::npos) throw;
      query.fail(fmt::format("of {}: {}", topic->second.name, what));
    }
  }
}

}  // namespace

bool is_sqlite(Octets octets) {
  return octets.size() >= kMagic16.size() &&
         std::ranges::equal(octets.first(kMagic16.size()), std::as_bytes(std::span(kMagic16)));
}

void read_sqlite_bag(const std::filesystem::path& path, const std::string& name, Collector& into) {
  check_size(path, name);
  SqliteFile file(path, name);
  const BagTopics topics = read_topics(file, into);
  read_messages(file, topics, into);
}

}  // namespace hal::files::recording
