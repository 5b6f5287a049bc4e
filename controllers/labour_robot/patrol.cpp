#include "controllers/labour_robot/patrol.h"

#include <algorithm>
#include <set>
#include <utility>

#include "controllers/labour/agent_called.h"
#include "hal/types/math.h"

namespace controllers {

std::vector<hal::ParameterSpec> Patrol::parameters() {
  using namespace std::chrono_literals;
  std::vector<hal::ParameterSpec> all = {
      {.name = "patrol.posts",
       .default_value = std::vector<std::string>{},
       .meaning = "Names of the agents between which it goes round.",
       .names = hal::Naming::kOtherAgent,
       .is_used = is_among_tasks},
      {"patrol.timeout", "s", 400, 1, 3600, "For the drive to a post; longer is a failure."},
      {"patrol.reached", "m", 4, 0.5, 1000, "A post has been reached below this."},
      {"patrol.stay", "s", 30, 0, 3600, "At a post."}};
  const Burst report{.messages = 1, .size = 16, .needed = 1, .within = 5s};
  for (hal::ParameterSpec& one : burst_parameters("patrol.", report)) all.push_back(std::move(one));
  return all;
}

bool Patrol::is_among_tasks(const hal::Parameters& parameters) {
  return std::ranges::find(parameters.texts("tasks"), kTask) != parameters.texts("tasks").end();
}

std::vector<hal::ParameterMistake> Patrol::mistakes(const hal::Parameters& parameters) {
  std::vector<hal::ParameterMistake> all;
  if (!is_among_tasks(parameters)) return all;
  if (parameters.text("sink").empty()) {
    all.push_back({"sink", "is not given; the task 'patrol' needs one"});
  }
  const std::vector<std::string>& posts = parameters.texts("patrol.posts");
  if (posts.empty()) {
    all.push_back({"patrol.posts", "is empty; the task 'patrol' needs one at least"});
  }
  std::set<std::string> seen;
  for (const std::string& post : posts) {
    if (!seen.insert(post).second) all.push_back({"patrol.posts", "'" + post + "' is there twice"});
  }
  return all;
}

Patrol::Patrol(hal::Robot& robot, Travel& travel, const hal::Parameters& parameters,
               hal::TimerId timer)
    : robot_(robot),
      travel_(travel),
      post_names_(parameters.texts("patrol.posts")),
      timeout_(hal::from_seconds(parameters["patrol.timeout"])),
      stay_(hal::from_seconds(parameters["patrol.stay"])),
      reached_(parameters["patrol.reached"]),
      burst_(burst_of(parameters, "patrol.", std::string(kTask))),
      report_(robot, timer) {}

void Patrol::start(hal::AgentId sink) {
  sink_ = sink;
  report_.start();
  for (const std::string& name : post_names_) {
    posts_.push_back(agent_called(robot_, name, "patrol.posts"));
  }
}

/// The localised posts, without the last one visited if there are others.
std::vector<hal::AgentId> Patrol::posts_in_sight() const {
  std::vector<hal::AgentId> all;
  for (const hal::AgentId post : posts_) {
    if (robot_.relative_position(post)) all.push_back(post);
  }
  if (all.size() > 1) std::erase_if(all, [this](hal::AgentId post) { return post == post_; });
  return all;
}

void Patrol::begin() {
  const auto posts = posts_in_sight();
  post_ = posts[robot_.random().below(static_cast<std::uint32_t>(posts.size()))];
  is_on_ = true;
  is_there_ = false;
  until_ = robot_.now() + timeout_;
  travel_.aim_anew();
  robot_.state("PATROL");
}

void Patrol::step() {
  if (!is_on_) return;
  if (robot_.now() < until_) return is_there_ ? void() : go();
  end(is_there_ && !report_.is_on() && report_.succeeded());
}

void Patrol::go() {
  const auto to = robot_.relative_position(*post_);
  if (!to) return travel_.halt();
  const double distance = hal::math::hypot(to->x, to->y);
  if (distance >= reached_) return travel_.drive(*to, distance);
  travel_.halt();
  is_there_ = true;
  until_ = robot_.now() + stay_;
  robot_.state("GATEWAY");
  report_.begin(burst_, sink_);
}

void Patrol::cancel() {
  report_.cancel();
  is_on_ = false;
}

void Patrol::end(bool succeeded) {
  travel_.halt();
  cancel();
  succeeded_ = succeeded;
  robot_.state("IDLE");
}

}  // namespace controllers
