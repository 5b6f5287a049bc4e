#include "controllers/ros_base/base_settings.h"

#include <algorithm>
#include <stdexcept>

#include "controllers/ros/ros_parameters.h"
#include "controllers/ros_base/base_topics.h"

namespace controllers {
namespace {

constexpr std::string_view kAgentName = "{}";

std::string with_name(std::string text, std::string_view agent) {
  for (std::size_t at = text.find(kAgentName); at != std::string::npos;
       at = text.find(kAgentName, at + agent.size())) {
    text.replace(at, kAgentName.size(), agent);
  }
  return text;
}

/// @throws std::invalid_argument
std::string checked_frame(const char* parameter, const std::string& text) {
  if (!text.empty()) return text;
  throw std::invalid_argument(std::string(parameter) + ": is empty");
}

/// @throws std::invalid_argument
std::array<double, 6> six_of(const char* parameter, const std::vector<double>& numbers) {
  std::array<double, 6> six{};
  if (numbers.size() != six.size()) {
    throw std::invalid_argument(std::string(parameter) + ": has " + std::to_string(numbers.size()) +
                                " numbers instead of 6");
  }
  std::ranges::copy(numbers, six.begin());
  return six;
}

/// @param rule  "scan:=laser/scan". @throws std::invalid_argument
std::pair<std::string, std::string> remap_of(const std::string& rule) {
  const std::size_t middle = rule.find(":=");
  if (middle == std::string::npos || middle == 0)
    throw std::invalid_argument("remap: '" + rule + "' must be FROM:=TO, such as scan:=laser");
  std::pair<std::string, std::string> names{rule.substr(0, middle), rule.substr(middle + 2)};
  ros_topic_name("", names.second);
  std::string known;
  for (const BaseTopic& topic : base_topics()) {
    if (topic.name == names.first) return names;
    known += (known.empty() ? "" : ", ") + std::string(topic.name);
  }
  if (names.first == kCommandTopic) return names;
  throw std::invalid_argument("remap: no topic '" + names.first + "'; there are " + known + ", " +
                              std::string(kCommandTopic));
}

std::set<std::string> set_of(const std::vector<std::string>& texts) {
  return {texts.begin(), texts.end()};
}

}  // namespace

BaseSettings base_settings(const hal::Parameters& parameters) {
  BaseSettings settings;
  settings.domain = ros_domain(parameters["domain"]);
  settings.name_space = parameters.text("namespace");
  ros_namespace("namespace", with_name(settings.name_space, "r0"));
  settings.odom_frame = checked_frame("odom_frame", parameters.text("odom_frame"));
  settings.base_frame = checked_frame("base_frame", parameters.text("base_frame"));
  settings.frame_prefix = parameters.text("frame_prefix");
  settings.topics = set_of(parameters.texts("topics"));
  if (parameters.flag("publish_clock")) settings.topics.insert("clock");
  settings.best_effort_topics = set_of(parameters.texts("best_effort_topics"));
  for (const std::string& rule : parameters.texts("remap")) settings.remaps.insert(remap_of(rule));
  settings.best_effort_commands = parameters.flag("best_effort");
  settings.use_stamped_vel = parameters.flag("use_stamped_vel");
  settings.use_sim_time = parameters.flag("use_sim_time");
  settings.pose_variances =
      six_of("pose_covariance_diagonal", parameters.numbers("pose_covariance_diagonal"));
  settings.twist_variances =
      six_of("twist_covariance_diagonal", parameters.numbers("twist_covariance_diagonal"));
  return settings;
}

BaseSettings settings_of_agent(BaseSettings settings, std::string_view agent) {
  settings.name_space = ros_namespace("namespace", with_name(settings.name_space, agent));
  settings.frame_prefix = with_name(settings.frame_prefix, agent);
  return settings;
}

}  // namespace controllers
