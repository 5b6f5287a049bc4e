#include "controllers/labour_robot/labour_robot.h"

#include <array>
#include <utility>

#include "controllers/labour/agent_called.h"

namespace controllers {
namespace {

constexpr hal::TimerId kReport = 1;
/// In the order of Task.
constexpr std::array<const char*, 3> kTaskNames{"answer", "patrol", "idle"};
constexpr const char* kAnswerPrefix = "answer.";

}  // namespace

LabourRobot::LabourRobot(hal::Robot& robot, const hal::Parameters& parameters)
    : robot_(robot),
      sink_name_(parameters.text("sink")),
      mistakes_(Patrol::mistakes(parameters)),
      fresh_for_(hal::from_seconds(parameters["answer.fresh_for"])),
      requester_beta_(parameters["answer.requester_beta"]),
      refusal_fails_(parameters.text("answer.refused") == "failure"),
      idle_(parameters["idle.lasts"]),
      weights_(parameters.texts("tasks"), parameters),
      travel_(robot, parameters),
      trip_(robot, travel_, parameters, kAnswerPrefix),
      patrol_(robot, travel_, parameters, kReport) {
  for (const std::string& task : weights_.tasks()) {
    std::size_t kind = 0;
    while (kind + 1 < kTaskNames.size() && task != kTaskNames.at(kind)) ++kind;
    kinds_.push_back(static_cast<Task>(kind));
  }
}

void LabourRobot::start() {
  refuse(mistakes_);
  if (weights_.find(std::string(Patrol::kTask))) {
    patrol_.start(agent_called(robot_, sink_name_, "sink"));
  }
  weights_.record(robot_);
  trip_.idle();
}

void LabourRobot::stop() {
  travel_.halt();
  weights_.record_outcomes(robot_);
}

void LabourRobot::step() {
  // The run may have lasted for less than fresh_for_.
  if (robot_.now() >= hal::Time{fresh_for_}) requesters_.forget_before(robot_.now() - fresh_for_);
  trip_.step();
  patrol_.step();
  settle();
  if (!current_) {
    if (const auto drawn = draw()) begin(*drawn);
  } else if (is_called_ && kinds_[*current_] != Task::kAnswer) {
    reconsider();
  }
  is_called_ = false;
}

void LabourRobot::receive(const hal::Message& message) {
  patrol_.receive(message);
  const auto heard = message.topic == kHelpTopic ? decode(message.payload) : std::nullopt;
  if (!heard) return;
  if (heard->word == HelpWord::kHelp && !trip_.is_to(message.source)) {
    requesters_.heard(message.source, robot_.now());
    heard_call_ = is_called_ = true;
  }
  trip_.receive(message.source, heard->word);
}

void LabourRobot::timer(hal::TimerId id) {
  if (id == kReport) patrol_.timer();
}

bool LabourRobot::can_do(Task task) const {
  if (task == Task::kAnswer) return !requesters_.empty();
  return task != Task::kPatrol || patrol_.can_begin();
}

std::optional<std::size_t> LabourRobot::draw() {
  std::vector<bool> possible;
  for (const Task kind : kinds_) possible.push_back(can_do(kind));
  return weights_.draw(possible, robot_.random());
}

void LabourRobot::begin(std::size_t task) {
  current_ = task;
  heard_call_ = false;
  if (kinds_[task] == Task::kIdle) {
    const double seconds = idle_ * (0.5 + robot_.random().uniform());
    idle_until_ = robot_.now() + hal::from_seconds(seconds);
  } else if (kinds_[task] == Task::kPatrol) {
    patrol_.begin();
  } else {
    const hal::AgentId mote = requesters_.draw(robot_, trip_.metric(), requester_beta_);
    requesters_.forget(mote);
    trip_.begin(mote);
  }
}

/// A mote called while the robot was on patrol or idle.
void LabourRobot::reconsider() {
  const auto drawn = draw();
  if (!drawn || kinds_[*drawn] != Task::kAnswer) return;
  patrol_.cancel();
  begin(*drawn);
}

bool LabourRobot::is_over() const {
  switch (kinds_[*current_]) {
    case Task::kAnswer:
      return !trip_.is_on();
    case Task::kPatrol:
      return !patrol_.is_on();
    case Task::kIdle:
      break;
  }
  return robot_.now() >= idle_until_;
}

bool LabourRobot::succeeded() const {
  switch (kinds_[*current_]) {
    case Task::kAnswer:
      return trip_.has_arrived();
    case Task::kPatrol:
      return patrol_.succeeded();
    case Task::kIdle:
      break;
  }
  return !heard_call_;
}

void LabourRobot::settle() {
  if (!current_ || !is_over()) return;
  const bool is_outcome =
      kinds_[*current_] != Task::kAnswer || refusal_fails_ || !trip_.was_refused();
  if (is_outcome) learn(*current_, succeeded());
  current_.reset();
}

void LabourRobot::learn(std::size_t task, bool succeeded) {
  const bool moved = weights_.learn(task, succeeded);
  weights_.record_outcome(robot_, task, succeeded);
  if (moved) weights_.record(robot_);
}

std::vector<hal::ParameterSpec> LabourRobot::parameters() {
  const std::vector<std::string> names(kTaskNames.begin(), kTaskNames.end());
  std::vector<hal::ParameterSpec> all = {
      {.name = "tasks",
       .default_value = names,
       .meaning = "Those it chooses among.",
       .choices = names},
      {.name = "sink",
       .default_value = "",
       .meaning = "Name of the mote to which it reports from its posts.",
       .names = hal::Naming::kAgent,
       .is_used = Patrol::is_among_tasks}};
  const auto add = [&all](std::vector<hal::ParameterSpec> some) {
    for (hal::ParameterSpec& one : some) all.push_back(std::move(one));
  };
  add(TaskWeights::parameters());
  add(Travel::parameters());
  add(HelpTrip::parameters(kAnswerPrefix));
  add({{"answer.fresh_for", "s", 35, 1, 3600,
        "A call is forgotten that was not repeated for so long: somebody goes, or it was given "
        "up."},
       {"answer.requester_beta", "1", 2, 0, 20,
        "Exponent of the metric of the route to a mote that called, in the choice among them."},
       {.name = "answer.refused",
        .default_value = "failure",
        .meaning = "What it is to be refused, because another robot has the task.",
        .choices = {"failure", "nothing"}}});
  add(Patrol::parameters());
  add({{"idle.lasts", "s", 30, 0.1, 3600, "On average; drawn from half to one and a half of it."}});
  return all;
}

std::vector<hal::ParameterMistake> LabourRobot::mistakes(const hal::Parameters& parameters) {
  auto all = TaskWeights::mistakes(parameters.texts("tasks"), parameters);
  for (hal::ParameterMistake& one : Patrol::mistakes(parameters)) all.push_back(std::move(one));
  return all;
}

std::vector<std::string> LabourRobot::states() {
  std::vector<std::string> all(HelpTrip::kStateNames.begin(), HelpTrip::kStateNames.end());
  all.insert(all.end(), {"PATROL", "GATEWAY"});
  return all;
}

}  // namespace controllers

BARAKA_CONTROLLER {
  return {.name = "labour_robot",
          .wants = {.channels = {"infrared", "localisation"},
                    .watched = {std::string(controllers::kHelpTopic)},
                    .names = true},
          .parameters = controllers::LabourRobot::parameters(),
          .judge = controllers::LabourRobot::mistakes,
          .states = controllers::LabourRobot::states(),
          .make_for_robot = hal::make_for_robot<controllers::LabourRobot>};
}
