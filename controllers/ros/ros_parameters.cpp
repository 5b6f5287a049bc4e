#include "controllers/ros/ros_parameters.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <stdexcept>
#include <string_view>

namespace controllers {
namespace {

/// Whether this is a valid part of a name between two slashes (ROS 2 design, "Topic and Service
/// name mapping to DDS").
bool is_token(std::string_view token) {
  if (token.empty() || std::isdigit(static_cast<unsigned char>(token.front())) != 0) return false;
  for (const char c : token) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '_') return false;
  }
  return true;
}

std::string namespace_mistake(const std::string& parameter, const std::string& text) {
  return parameter + ": '" + text +
         "' must be words of letters, digits and '_' with '/' between them, such as fleet/r0";
}

}  // namespace

std::string ros_namespace(const std::string& parameter, const std::string& text) {
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t end = std::min(text.find('/', begin), text.size());
    if (!is_token(std::string_view(text).substr(begin, end - begin))) {
      throw std::invalid_argument(namespace_mistake(parameter, text));
    }
    begin = end + 1;
  }
  return text;
}

int ros_domain(double number) {
  if (number == std::floor(number)) return static_cast<int>(number);
  throw std::invalid_argument("domain: must be a whole number, not " + std::to_string(number));
}

std::string ros_topic(const std::string& name_space, const std::string& name) {
  return "rt/" + (name_space.empty() ? name : name_space + "/" + name);
}

std::string ros_topic_name(const std::string& name_space, const std::string& name) {
  const bool is_absolute = name.starts_with('/');
  const std::string relative = ros_namespace("topic", name.substr(is_absolute ? 1 : 0));
  if (relative.empty()) throw std::invalid_argument("topic: '" + name + "' is no name");
  return ros_topic(is_absolute ? "" : name_space, relative);
}

}  // namespace controllers
