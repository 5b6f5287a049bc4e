#include "controllers/labour_mote/labour_mote.h"

#include <limits>
#include <utility>

#include "controllers/labour/agent_called.h"

namespace controllers {
namespace {

using namespace std::chrono_literals;

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr hal::TimerId kChoose = 1;
constexpr hal::TimerId kDelivery = 2;
constexpr std::string_view kHelpTask = "help";

/// Bursts of the sampling tasks, by the names of the tasks.
std::vector<Burst> sampling_defaults() {
  return {
      {.topic = "temperature", .messages = 1, .size = 16, .needed = 1, .within = 5s},
      {.topic = "audio", .messages = 10, .size = 160, .interval = 20ms, .needed = 9, .within = 2s},
      {.topic = "video",
       .messages = 20,
       .size = 1024,
       .interval = 40ms,
       .needed = 18,
       .within = 2s}};
}

std::vector<std::string> task_names() {
  std::vector<std::string> names;
  for (const Burst& one : sampling_defaults()) names.push_back(one.topic);
  names.emplace_back(kHelpTask);
  return names;
}

std::string in_capitals(std::string text) {
  for (char& letter : text) {
    if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
  }
  return text;
}

std::vector<hal::ParameterMistake> mistakes_of_sink(const hal::Parameters& parameters) {
  if (!parameters.text("sink").empty()) return {};
  for (const std::string& task : parameters.texts("tasks")) {
    if (task != kHelpTask) {
      return {{"sink", "is not given; the task '" + task + "' needs one"}};
    }
  }
  return {};
}

}  // namespace

LabourMote::LabourMote(hal::Mote& mote, const hal::Parameters& parameters)
    : mote_(mote),
      sink_name_(parameters.text("sink")),
      mistakes_(mistakes_of_sink(parameters)),
      rest_(parameters["rest"]),
      rest_in_need_(parameters["help.rest"]),
      weights_(parameters.texts("tasks"), parameters),
      help_(weights_.find(std::string(kHelpTask))),
      needs_(parameters["help.at"], parameters["help.every"]),
      call_(mote, parameters, "help."),
      delivery_(mote, kDelivery),
      received_(mote) {
  for (const std::string& task : weights_.tasks()) {
    const bool is_sampling = task != kHelpTask;
    bursts_.push_back(is_sampling ? burst_of(parameters, task + ".", task) : Burst{});
  }
}

void LabourMote::start() {
  refuse(mistakes_);
  if (!sink_name_.empty()) sink_ = agent_called(mote_, sink_name_, "sink");
  delivery_.start();
  weights_.record(mote_);
  call_.idle();
  choose_in(rest_ * mote_.random().uniform());
}

void LabourMote::step() {
  if (help_ && needs_.falls_due(mote_.now()) && !call_.is_on()) {
    needs_help_ = true;
    mote_.record("needs", ++needs_so_far_);
    if (!current_) rest();
  }
  call_.step();
  settle();
}

void LabourMote::receive(const hal::Message& message) {
  call_.receive(message);
  delivery_.receive(message);
  if (message.topic != kHelpTopic && sink_ == mote_.id()) received_.receive(message);
  settle();
}

void LabourMote::timer(hal::TimerId id) {
  if (id == kChoose) return choose();
  delivery_.timer();
  settle();
}

void LabourMote::stop() {
  weights_.record_outcomes(mote_);
  received_.record(mote_);
}

void LabourMote::choose_in(double seconds) {
  (void)mote_.set_timer(kChoose, mote_.now() + hal::from_seconds(seconds));
}

/// Waits after a task, or when none can be done: a random 0.5 to 1.5 of the resting time, so that
/// motes do not keep in step.
void LabourMote::rest() {
  choose_in((needs_help_ ? rest_in_need_ : rest_) * (0.5 + mote_.random().uniform()));
}

void LabourMote::choose() {
  std::vector<bool> can_do(weights_.tasks().size(), true);
  if (help_) can_do[*help_] = needs_help_;
  current_ = weights_.draw(can_do, mote_.random());
  if (!current_) return rest();
  if (current_ == help_) return call_.begin();
  mote_.state(in_capitals(weights_.tasks()[*current_]));
  delivery_.begin(bursts_[*current_], *sink_);
  settle();
}

/// Ends the current task if it is over.
void LabourMote::settle() {
  if (!current_) return;
  const bool is_help = current_ == help_;
  if (is_help ? call_.is_on() : delivery_.is_on()) return;
  const bool succeeded =
      is_help ? call_.state() == HelpCall::State::kFulfilled : delivery_.succeeded();
  if (is_help) {
    needs_help_ = false;
  } else {
    mote_.state("IDLE");
  }
  const bool moved = weights_.learn(*current_, succeeded);
  weights_.record_outcome(mote_, *current_, succeeded);
  if (moved) weights_.record(mote_);
  current_.reset();
  rest();
}

std::vector<hal::ParameterSpec> LabourMote::parameters() {
  std::vector<hal::ParameterSpec> all = {
      {.name = "tasks",
       .default_value = task_names(),
       .meaning = "Those it chooses among.",
       .choices = task_names()},
      {.name = "sink",
       .default_value = "",
       .meaning = "Name of the mote that gets the samples; that one gets its own at once.",
       .names = hal::Naming::kAgent},
      {"rest", "s", 20, 0.1, 3600,
       "From the end of a task to the next choice, on average; drawn from half to one and a half "
       "of it."}};
  const auto add = [&all](std::vector<hal::ParameterSpec> some) {
    for (hal::ParameterSpec& one : some) all.push_back(std::move(one));
  };
  add(TaskWeights::parameters());
  for (const Burst& one : sampling_defaults()) add(burst_parameters(one.topic + ".", one));
  add({{"help.at", "s", kNever, 0, kNever, "When it needs help."},
       {"help.every", "s", kNever, 1, kNever,
        "Time from one need to the next; one that comes up while it calls is left out."},
       {"help.rest", "s", 2, 0.1, 3600, "Instead of `rest`, while it needs help."}});
  add(HelpCall::parameters("help."));
  return all;
}

std::vector<hal::ParameterMistake> LabourMote::mistakes(const hal::Parameters& parameters) {
  auto all = TaskWeights::mistakes(parameters.texts("tasks"), parameters);
  for (hal::ParameterMistake& one : mistakes_of_sink(parameters)) all.push_back(std::move(one));
  return all;
}

std::vector<std::string> LabourMote::states() {
  std::vector<std::string> all(HelpCall::kStateNames.begin(), HelpCall::kStateNames.end());
  for (const Burst& one : sampling_defaults()) all.push_back(in_capitals(one.topic));
  return all;
}

}  // namespace controllers

BARAKA_CONTROLLER {
  return {.name = "labour_mote",
          .wants = {.names = true},
          .parameters = controllers::LabourMote::parameters(),
          .judge = controllers::LabourMote::mistakes,
          .states = controllers::LabourMote::states(),
          .make_for_mote = hal::make_for_mote<controllers::LabourMote>};
}
