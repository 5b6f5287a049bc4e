// The topics of a record.
#include "results/record/topics.h"

#include <algorithm>
#include <vector>

#include "results/record/agent_use_log.h"
#include "results/record/air_log.h"
#include "results/record/association_log.h"
#include "results/record/body_log.h"
#include "results/record/controller_log.h"
#include "results/record/event_log.h"
#include "results/record/frame_counts.h"
#include "results/record/frame_log.h"
#include "results/record/interface_counts.h"
#include "results/record/ledger_tables.h"
#include "results/record/look_log.h"
#include "results/record/message_counts.h"
#include "results/record/message_log.h"
#include "results/record/message_sample.h"
#include "results/record/movable_log.h"
#include "results/record/observable_tables.h"
#include "results/record/relay_counts.h"
#include "results/record/route_log.h"
#include "results/record/routing_counts.h"
#include "results/record/run_tables.h"
#include "results/record/schema.h"
#include "results/record/station_queues.h"

namespace results::record {
namespace {

using sim::scenario::Detail;

struct Topic {
  std::vector<Table> (*tables)();
  void (*add)(Recording&) = nullptr;  ///< Null: another topic, or the Recorder, writes the tables.
};

/// Adds a writer that is always needed and takes no other arguments.
template <class One>
void add_plain(Recording& of) {
  of.add<One>(of.database, of.commits);
}
void add_frame_counts(Recording& of) {
  if (of.options.counts_frames()) of.add<FrameCounts>(of.database, of.config.radio, of.commits);
}
void add_message_log(Recording& of) {
  if (of.options.messages == Detail::kAll)
    of.add<MessageLog>(of.database, of.protocols, of.commits);
  if (of.options.messages == Detail::kSample)
    of.add<MessageSample>(of.database, of.protocols, of.commits);
}
void add_message_counts(Recording& of) {
  if (of.options.messages == Detail::kCounts) of.add<MessageCounts>(of.database, of.protocols);
}
void add_air(Recording& of) {
  const auto has_network = [](const auto& agent) { return agent.network.has_value(); };
  if (std::ranges::any_of(of.config.agents, has_network))
    of.add<AirLog>(of.database, of.options.samples);
}
void add_bodies(Recording& of) { of.add<BodyLog>(of.database, of.options.pose_period, of.commits); }
void add_movables(Recording& of) {
  if (!of.config.movables.empty())
    of.add<MovableLog>(of.database, of.config.movables, of.options.pose_period, of.commits);
}
void add_use(Recording& of) { of.add<AgentUseLog>(of.database, of.options.counts_frames()); }
void add_interfaces(Recording& of) { of.add<InterfaceCounts>(of.database); }
void add_routes(Recording& of) {
  if (of.options.routes == Detail::kAll) of.add<RouteLog>(of.database, of.protocols, of.commits);
}
void add_looks(Recording& of) {
  const LookLog::Settings settings{.period = of.options.pose_period,
                                   .readings = of.options.readings,
                                   .queues = of.options.routes == Detail::kAll};
  if (settings.queues || settings.readings != Detail::kNone)
    of.add<LookLog>(of.database, settings, of.commits);
}
void add_frame_log(Recording& of) {
  const Detail frames = of.options.frames;
  if (frames == Detail::kSample || frames == Detail::kAll)
    of.add<FrameLog>(of.database, frames, of.protocols, of.commits);
}
void add_events(Recording& of) {
  of.add<EventLog>(of.database, of.options.inputs == Detail::kAll, of.commits);
}
void add_relays(Recording& of) {
  if (of.options.counts_frames()) of.add<RelayCounts>(of.database);
}

void add_station_queues(Recording& of) {
  if (of.options.counts_frames()) of.add<StationQueues>(of.database);
}

/// In the order of the tables in the file, which is also the order of the writers' callbacks:
/// writers that count frames come before those that list them, because a listed row can cause a
/// commit of the totals.
constexpr Topic kTopics[] = {
    {run_tables},
    {countable_tables},
    {FrameCounts::sent_tables, add_frame_counts},
    {AssociationLog::tables, add_plain<AssociationLog>},
    {FrameCounts::end_tables},
    {FramesInTheAir::tables},
    {FrameCounts::link_views},
    {FrameCounts::sum_views},
    {MessageLog::tables, add_message_log},
    {RoutingCounts::tables, add_plain<RoutingCounts>},
    {MessageCounts::tables, add_message_counts},
    {MessageWriter::end_views},
    {MessageWriter::delivery_views},
    {ledger_tables, add_air},
    {observable_tables},
    {BodyLog::tables, add_bodies},
    {MovableLog::tables, add_movables},
    {ControllerLog::state_tables, add_plain<ControllerLog>},
    {EventLog::scripted_tables, add_events},
    {ControllerLog::value_tables},
    {AgentUseLog::tables, add_use},
    {InterfaceCounts::tables, add_interfaces},
    {RouteLog::tables, add_routes},
    {LookLog::tables, add_looks},
    {BodyLog::contact_tables},
    {EventLog::tables},
    {fingerprint_tables},
    {FrameLog::tables, add_frame_log},
    {RelayCounts::tables, add_relays},
    {StationQueues::tables, add_station_queues},
};

}  // namespace

void add_writers(Recording& recording) {
  for (const Topic& topic : kTopics) {
    if (topic.add != nullptr) topic.add(recording);
  }
}

const std::vector<Table>& tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> sum;
    for (const Topic& topic : kTopics) {
      const std::vector<Table> part = topic.tables();
      sum.insert(sum.end(), part.begin(), part.end());
    }
    return sum;
  }();
  return all;
}

}  // namespace results::record
