#include "gateway/server/admission.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "hal/types/pattern.h"

namespace gateway::server {
namespace {

using hal::node::exchange::AgentOffer;
using hal::node::exchange::Hello;
using hal::node::exchange::Session;

const char* name_of(hal::AgentKind kind) {
  return kind == hal::AgentKind::kRobot ? "robot" : "mote";
}

/// Whether a pattern matches only its own text. Most do, if many agents are asked for individually.
bool is_plain(const std::string& pattern) {
  return pattern.find_first_of("*?") == std::string::npos;
}

}  // namespace

Admission::Admission(std::vector<AgentOffer> offers, std::uint64_t run, Offered offered)
    : run_(run), offered_(offered) {
  std::ranges::sort(offers, {}, [](const AgentOffer& offer) { return offer.session.agent; });
  for (AgentOffer& offer : offers) {
    by_name_.emplace(offer.session.name, places_.size());
    places_.push_back({std::move(offer), {}});
  }
}

Session Admission::decide(const Hello& hello) {
  const auto known = granted_.find(hello.instance);
  if (known != granted_.end()) return known->second;
  const std::string refusal = refusal_of(hello);
  if (refusal.empty()) return grant(hello);
  Session session;
  session.instance = hello.instance;
  session.run = run_;
  session.refusal = refusal;
  return session;
}

std::string Admission::refusal_of(const Hello& hello) const {
  if (hello.version != hal::node::exchange::kProtocolVersion) {
    return fmt::format("protocol version {}; this server speaks {}", hello.version,
                       hal::node::exchange::kProtocolVersion);
  }
  if (closed_) return "the run has begun; no process can join it";
  if (hello.process.empty()) return "the process has no name";
  for (const auto& [instance, name] : process_names_) {
    if (name == hello.process) return fmt::format("another process is called '{}'", name);
  }
  if (std::string unknown = unknown_in(hello); !unknown.empty()) return unknown;
  for (const std::size_t place : asked_for(hello)) {
    if (std::string reason = objection(places_[place], hello); !reason.empty()) return reason;
  }
  return {};
}

template <class Visit>
void Admission::for_each_fit(const std::string& pattern, Visit visit) const {
  if (is_plain(pattern)) {
    if (const auto named = by_name_.find(pattern); named != by_name_.end()) visit(named->second);
    return;
  }
  for (const auto& [name, place] : by_name_) {
    if (hal::matches(pattern, name)) visit(place);
  }
}

bool Admission::fits_one(const std::string& pattern) const {
  bool fits = false;
  for_each_fit(pattern, [&fits](std::size_t) { fits = true; });
  return fits;
}

std::vector<std::size_t> Admission::asked_for(const Hello& hello) const {
  std::vector<std::size_t> places;
  for (const std::string& pattern : hello.patterns) {
    for_each_fit(pattern, [&places](std::size_t place) { places.push_back(place); });
  }
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

bool Admission::is_for_others(const Hello& hello) const {
  return offered_ == Offered::kSome &&
         std::ranges::none_of(hello.patterns, [this](const auto& p) { return fits_one(p); });
}

std::string Admission::unknown_in(const Hello& hello) const {
  if (hello.patterns.empty()) return "it asks for no agent";
  const auto unknown =
      std::ranges::find_if(hello.patterns, [this](const auto& p) { return !fits_one(p); });
  if (unknown == hello.patterns.end()) return {};
  if (offered_ == Offered::kSome && !is_for_others(hello)) return {};
  return fmt::format("unknown agent '{}'", *unknown);
}

std::string Admission::objection(const Place& place, const Hello& hello) const {
  const auto& [session, program] = place.offer;
  if (!place.holder.empty()) {
    return fmt::format("agent '{}' is taken by process '{}'", session.name,
                       process_names_.at(place.holder));
  }
  if (!program.empty() && program != hello.program) {
    return fmt::format("agent '{}' is for program '{}', not '{}'", session.name, program,
                       hello.program);
  }
  if (!hello.both_kinds && hello.kind != session.kind) {
    return fmt::format("agent '{}' is a {}; '{}' drives a {}", session.name, name_of(session.kind),
                       hello.program, name_of(hello.kind));
  }
  const auto granted = hal::node::exchange::session_for(place.offer, hello.wants);
  return granted ? std::string() : granted.error().message;
}

Session Admission::grant(const Hello& hello) {
  Session session;
  session.instance = hello.instance;
  session.run = run_;
  for (const std::size_t index : asked_for(hello)) {
    Place& place = places_[index];
    place.holder = hello.instance;
    session.agents.push_back(*hal::node::exchange::session_for(place.offer, hello.wants));
  }
  process_names_[hello.instance] = hello.process;
  granted_[hello.instance] = session;
  return session;
}

void Admission::release(const std::string& instance) {
  for (Place& place : places_) {
    if (place.holder == instance) place.holder.clear();
  }
  granted_.erase(instance);
  process_names_.erase(instance);
}

bool Admission::is_complete() const {
  return std::ranges::none_of(places_, [](const Place& place) { return place.holder.empty(); });
}

std::vector<hal::AgentId> Admission::free_agents() const {
  std::vector<hal::AgentId> agents;
  for (const Place& place : places_) {
    if (place.holder.empty()) agents.push_back(place.offer.session.agent);
  }
  return agents;
}

std::vector<std::string> Admission::missing() const {
  std::vector<std::string> names;
  for (const Place& place : places_) {
    if (!place.holder.empty()) continue;
    const auto& [session, program] = place.offer;
    names.push_back(program.empty() ? session.name : fmt::format("{} ({})", session.name, program));
  }
  return names;
}

}  // namespace gateway::server
