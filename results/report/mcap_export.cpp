#include "results/report/mcap_export.h"

#include <algorithm>

#include "results/report/mcap_streams.h"

namespace results::report {
namespace {

constexpr std::int64_t kToNeighbours = 65534, kToEveryone = 65535;

std::map<std::int64_t, std::string> agent_names(record::RunReader& reader) {
  std::map<std::int64_t, std::string> names{{kToEveryone, "everyone"},
                                            {kToNeighbours, "neighbours"}};
  record::Statement agents = reader.query("SELECT agent, name FROM agents");
  while (agents.next()) names[agents.integer(0)] = agents.text(1);
  return names;
}

McapWriter::Texts run_keys_of(record::RunReader& reader) {
  McapWriter::Texts texts;
  record::Statement keys = reader.query("SELECT key, value FROM run");
  while (keys.next()) texts[keys.text(0)] = keys.text(1);
  return texts;
}

/// The stream whose next row is earliest; of equal times, the first stream. Null: no rows are left.
McapStream* earliest(const McapStreams& streams) {
  McapStream* found = nullptr;
  for (const auto& stream : streams) {
    if (!stream->has_more()) continue;
    if (found == nullptr || stream->at_ns() < found->at_ns()) found = stream.get();
  }
  return found;
}

}  // namespace

std::uint64_t write_mcap(const std::filesystem::path& folder, const ExportedScene& scene,
                         const std::function<void(std::string_view)>& write) {
  record::RunReader reader(folder);
  const auto names = agent_names(reader);
  McapWriter file("ros2", "baraka", write);
  McapTopics topics(file);
  const McapParts parts{reader, scene, topics, names};
  file.add_metadata("baraka", run_keys_of(reader));
  publish_static_transforms(parts);
  publish_walls(parts);
  McapStreams streams;
  add_pose_streams(parts, streams);
  add_movable_stream(parts, streams);
  add_reading_streams(parts, streams);
  add_network_streams(parts, streams);
  add_route_stream(parts, streams);
  add_controller_streams(parts, streams);
  while (McapStream* const next = earliest(streams)) next->take_instant();
  file.finish();
  return file.messages();
}

}  // namespace results::report
