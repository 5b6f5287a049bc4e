#include "results/report/report_page.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <tuple>

#include "results/report/air_sums.h"
#include "results/report/experiment_section.h"
#include "results/report/log_histogram.h"
#include "results/report/paper.h"
#include "results/report/plot.h"
#include "results/report/relay_sums.h"
#include "results/report/report_page_queues.h"
#include "results/report/report_sections.h"
#include "results/report/svg.h"

namespace results::report {
namespace {

using Json = nlohmann::ordered_json;

/// Time between the marks along a trajectory, s, as in Fig. 11 of the paper.
constexpr double kTickPeriod = 30;
/// Most marks along a trajectory. Their period is doubled until there are no more, for the first
/// time in a run longer than 83 h.
constexpr double kMostTicks = 10'000;

Json to_json(const std::optional<Quantiles>& q) {
  if (!q) return nullptr;
  return {{"min", q->min}, {"q1", q->q1}, {"median", q->median}, {"q3", q->q3}, {"max", q->max}};
}

Json to_json(const RunResult::Place& place) { return {place.at, place.x, place.y}; }

/// The robot's places at the marks until the run ended. A track has a row only when the robot has
/// moved, so the latest earlier row counts.
Json ticks_of(const std::vector<RunResult::Place>& track, double end) {
  Json ticks = Json::array();
  std::size_t row = 0;
  double period = kTickPeriod;
  while (end / period > kMostTicks) period *= 2;
  for (int i = 0; i * period <= end && !track.empty(); ++i) {
    const double at = i * period;
    while (row + 1 < track.size() && track[row + 1].at <= at) ++row;
    ticks.push_back(to_json({.at = at, .x = track[row].x, .y = track[row].y}));
  }
  return ticks;
}

Json to_json(const RunResult& run) {
  Json json = {{"folder", run.folder},
               {"seed", run.value("seed")},
               {"result", run.value("result")},
               {"simulated_s", run.number("simulated_s")},
               {"robots", Json::array()}};
  for (const RunResult::Agent& agent : run.agents) {
    const auto track = run.tracks.find(agent.agent);
    if (track == run.tracks.end()) continue;
    Json places = Json::array();
    for (const RunResult::Place& place : track->second) places.push_back(to_json(place));
    json["robots"].push_back({{"name", agent.name},
                              {"track", std::move(places)},
                              {"ticks", ticks_of(track->second, run.number("simulated_s"))}});
  }
  return json;
}

/// @param times_ns  times by run.
Json times_json(const std::vector<std::vector<std::int64_t>>& times_ns) {
  std::vector<double> pooled;
  for (const auto& run : times_ns) {
    for (const std::int64_t ns : run) pooled.push_back(static_cast<double>(ns) * 1e-9);
  }
  const LogHistogram histogram = log_histogram(pooled);
  return {{"quantiles", to_json(quantiles(pooled))},
          {"bins", histogram.bins},
          {"zeros", histogram.zeros},
          {"below", histogram.below},
          {"above", histogram.above},
          {"runs_ns", times_ns}};
}

Json discovery_json(const Group& group) {
  std::vector<std::vector<std::int64_t>> times;
  for (const RunResult* run : group.runs) times.push_back(run->discoveries_ns);
  return times_json(times);
}

Json delay_json(const Group& group) {
  std::vector<std::vector<std::int64_t>> times;
  for (const RunResult* run : group.runs) {
    auto& delays = times.emplace_back();
    for (const RunResult::Delivery& delivery : run->deliveries) delays.push_back(delivery.delay_ns);
  }
  return times_json(times);
}

Json nodes_json(const Group& group) {
  const RunResult& first = *group.runs.front();
  const auto packets = group.packets();
  Json nodes = Json::array();
  for (const RunResult::Agent& agent : first.agents) {
    nodes.push_back({{"name", agent.name},
                     {"robot", agent.is_robot},
                     {"goal", first.goal == agent.agent},
                     {"x", agent.x},
                     {"y", agent.y},
                     {"packets", packets.at(agent.agent)}});
  }
  return nodes;
}

/// Links as pairs of indices into the list of nodes.
Json links_json(const RunResult& run) {
  std::map<int, std::size_t> place;
  for (std::size_t i = 0; i < run.agents.size(); ++i) place[run.agents[i].agent] = i;
  Json links = Json::array();
  for (const auto& [a, b] : run.links) links.push_back({place.at(a), place.at(b)});
  return links;
}

Json walls_json(const RunResult& run) {
  Json walls = Json::array();
  for (const RunResult::Wall& wall : run.walls) {
    walls.push_back({{"name", wall.name},
                     {"x", wall.x},
                     {"y", wall.y},
                     {"yaw", wall.yaw},
                     {"length_x", wall.length_x},
                     {"length_y", wall.length_y}});
  }
  return walls;
}

Json verdicts_json(const Group& group) {
  std::map<std::tuple<std::string, bool, std::string>, std::uint64_t> sums;
  for (const RunResult* run : group.runs) {
    for (const RunResult::FrameVerdict& one : run->frame_verdicts) {
      sums[{one.kind, one.addressed, one.verdict}] += one.count;
    }
  }
  Json rows = Json::array();
  for (const auto& [key, count] : sums) {
    const auto& [kind, addressed, verdict] = key;
    rows.push_back(
        {{"class", kind}, {"addressed", addressed}, {"verdict", verdict}, {"count", count}});
  }
  return rows;
}

/// Verdicts by link; both ends are indices into the list of nodes.
Json link_verdicts_json(const Group& group) {
  std::map<int, std::size_t> place;
  const auto& agents = group.runs.front()->agents;
  for (std::size_t i = 0; i < agents.size(); ++i) place[agents[i].agent] = i;
  Json links = Json::array();
  for (const LinkSums& link : group.link_verdicts()) {
    const auto from = place.find(link.from), to = place.find(link.to);
    if (from == place.end() || to == place.end()) continue;  // an agent of another run only
    links.push_back({from->second, to->second, link.verdicts});
  }
  return links;
}

Json topics_json(const Group& group) {
  Json topics = Json::array();
  for (const TopicSums& one : topic_sums(group)) {
    Json topic = {{"topic", one.topic},         {"samples", one.samples},
                  {"delivered", one.delivered}, {"first_try", one.first_try},
                  {"repaired", one.repaired},   {"airtime_ns", one.airtime_ns}};
    const auto p50 = latency_quantile(one.latencies, 0.5);
    const auto p99 = latency_quantile(one.latencies, 0.99);
    topic["p50"] = p50 ? Json(*p50) : Json(nullptr);
    topic["p99"] = p99 ? Json(*p99) : Json(nullptr);
    topics.push_back(std::move(topic));
  }
  return topics;
}

/// Air time of a run by second and use.
Json air_seconds_json(const RunResult& run) {
  std::map<std::pair<std::int64_t, std::string>, std::int64_t> sums;
  for (const RunResult::AirSecond& one : run.air_seconds)
    sums[{one.second, use_of(one.purpose, one.kind)}] += one.airtime_ns;
  Json seconds = Json::array();
  for (const auto& [key, airtime_ns] : sums) seconds.push_back({key.first, key.second, airtime_ns});
  return seconds;
}

Json air_json(const Group& group) {
  Json json = {
      {"topics", topics_json(group)}, {"kinds", Json::array()}, {"seconds", Json::array()}};
  for (const RunResult::AirKind& one : kind_sums(group)) {
    json["kinds"].push_back({{"purpose", one.purpose},
                             {"kind", one.kind},
                             {"port", one.port ? Json(*one.port) : Json(nullptr)},
                             {"frames", one.frames},
                             {"retries", one.retries},
                             {"submessages", one.submessages},
                             {"bits", one.bits},
                             {"airtime_ns", one.airtime_ns}});
  }
  for (const RunResult* run : group.runs) json["seconds"].push_back(air_seconds_json(*run));
  return json;
}

Json sample_losses_json(const Group& group) {
  Json losses = Json::array();
  for (const auto& [key, count] : sample_loss_sums(group)) {
    const auto& [topic, verdict, at] = key;
    losses.push_back({topic, verdict, at, count});
  }
  return losses;
}

Json to_json(const Group& group) {
  Json json = {{"name", group.name},
               {"full_name", group.full_name},
               {"is_the_papers", group.is_the_papers()},
               {"not_the_papers", group.not_the_papers},
               {"left_out", group.left_out},
               {"runs", Json::array()}};
  if (group.runs.empty()) return json;
  for (const RunResult* run : group.runs) json["runs"].push_back(to_json(*run));
  json["recorded"] = Json::array();
  for (const RecordedTable& table : recorded_tables(group)) {
    json["recorded"].push_back(
        {{"title", table.title}, {"file", table.file}, {"rows", table.rows}});
  }
  json["scenario"] = group.runs.front()->value("scenario");
  json["nodes"] = nodes_json(group);
  json["links"] = links_json(*group.runs.front());
  json["walls"] = walls_json(*group.runs.front());
  json["verdicts"] = verdicts_json(group);
  json["link_verdicts"] = link_verdicts_json(group);
  json["air"] = air_json(group);
  json["sample_losses"] = sample_losses_json(group);
  json["relays"] = relays_json(group);
  json["queues"] = queues_json(group);
  json["discovery"] = discovery_json(group);
  json["delay"] = delay_json(group);
  return json;
}

Json to_json(const Plot& plot) {
  return {{"name", plot.name},
          {"title", plot.title},
          {"kind", sim::scenario::name_of(plot.kind)},
          {"svg", plot.kind == sim::scenario::PlotKind::kTable ? "" : svg(plot)},
          {"rows", plot_rows(plot)},
          {"notes", plot.notes}};
}

Json to_json(const Experiment& experiment) {
  Json json = {{"settings", experiment.points.size()},
               {"runs", experiment.runs.size()},
               {"left_out", experiment.left_out},
               {"factors", Json::array()},
               {"plots", Json::array()}};
  for (const Experiment::Factor& factor : experiment.factors) json["factors"].push_back(factor.key);
  for (const sim::scenario::PlotRequest& request : requests_of(experiment)) {
    json["plots"].push_back(to_json(make_plot(experiment, request)));
  }
  return json;
}

Json paper_json() {
  return {{"discovery", to_json(std::optional(paper::kDiscovery))},
          {"delay", to_json(std::optional(paper::kDelay))},
          {"most_packets", paper::kMostPackets},
          {"least_packets", paper::kLeastPackets},
          {"runs", paper::kRuns},
          {"basis", paper::kBasisMeaning},
          {"no_tail", paper::kNoTail}};
}

}  // namespace

std::string report_json(const std::vector<Group>& groups,
                        const std::vector<Experiment>& experiments) {
  Json json = {
      {"paper", has_the_papers(groups) ? paper_json() : Json(nullptr)},
      {"differences", Json::array()},
      {"comparison", Json::array()},
      {"histogram", {{"low_s", LogHistogram::kLow}, {"high_s", LogHistogram::kHigh}}},
      {"groups", Json::array()},
  };
  for (const ComparisonRow& row : comparison_rows(groups)) {
    json["comparison"].push_back(
        {{"figure", row.figure}, {"paper", row.paper}, {"ours", row.ours}});
    Json& json_row = json["comparison"].back();
    json_row["basis"] = paper::name_of(row.basis);
    json_row["far_off"] = Json::array();
    for (const auto& times : row.times_paper) json_row["far_off"].push_back(is_far_off(times));
  }
  for (const Difference& difference : differences(groups)) {
    json["differences"].push_back({{"key", difference.key}, {"values", difference.values}});
  }
  for (const Group& group : groups) json["groups"].push_back(to_json(group));
  json["experiments"] = Json::array();
  for (const Experiment& one : experiments) json["experiments"].push_back(to_json(one));
  // Names of folders may be in any encoding.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string report_page(const Sources& sources, const std::optional<Settings>& case_study,
                        std::string page) {
  constexpr std::string_view kPlace = "\"BARAKA FIGURES\"";
  const std::size_t place = page.find(kPlace);
  if (place == std::string::npos) throw std::runtime_error("the page has no place for figures");
  std::string json = report_json(group_runs(sources.runs, case_study), sources.experiments);
  // "<" is written "\u003c", so that no name can end the script element that holds the JSON.
  for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos;) {
    json.replace(at, 1, "\\u003c");
  }
  page.replace(place, kPlace.size(), json);
  return page;
}

}  // namespace results::report
