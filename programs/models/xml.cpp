#include "programs/models/xml.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "hal/types/math.h"

namespace programs::models {

namespace {

constexpr std::string_view kSpace = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

}  // namespace

std::string title(const Element& element) {
  const char* const name = element.Attribute("name");
  return fmt::format("<{}>{}", element.Name(), name == nullptr ? "" : fmt::format(" '{}'", name));
}

std::string text_of(const Element& element, const char* attribute) {
  const char* const text = element.Attribute(attribute);
  if (text == nullptr || *text == '\0')
    throw ModelError(element.GetLineNum(), fmt::format("{} has no {}", title(element), attribute));
  return text;
}

double parsed_number(std::string_view text, const Element& element, const char* what) {
  std::string_view number = trimmed(text);
  if (number.starts_with('+')) number.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(value))
    throw ModelError(element.GetLineNum(),
                     fmt::format("{}: {}: '{}' is not a number", title(element), what, text));
  return value;
}

double number_of(const Element& element, const char* attribute) {
  return parsed_number(text_of(element, attribute), element, attribute);
}

std::optional<double> number_if_there(const Element& element, const char* attribute) {
  if (element.Attribute(attribute) == nullptr) return std::nullopt;
  return number_of(element, attribute);
}

Eigen::Vector3d vector_of(const Element& element, const char* attribute,
                          const Eigen::Vector3d& otherwise) {
  if (element.Attribute(attribute) == nullptr) return otherwise;
  const std::string text = element.Attribute(attribute);
  std::string_view rest = trimmed(text);
  Eigen::Vector3d vector;
  for (int i = 0; i < 3; ++i) {
    const std::size_t end = i < 2 ? rest.find_first_of(kSpace) : rest.size();
    if (rest.empty() || end == std::string_view::npos)
      throw ModelError(element.GetLineNum(), fmt::format("{}: {}: '{}' are not three numbers",
                                                         title(element), attribute, text));
    vector[i] = parsed_number(rest.substr(0, end), element, attribute);
    rest = trimmed(rest.substr(end));
  }
  return vector;
}

Eigen::Isometry3d pose_from(const Eigen::Vector3d& xyz, const Eigen::Vector3d& rpy) {
  const auto turn = [](double angle, int a, int b) {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    matrix(a, a) = matrix(b, b) = hal::math::cos(angle);
    matrix(b, a) = hal::math::sin(angle);
    matrix(a, b) = -matrix(b, a);
    return matrix;
  };
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn(rpy.z(), 0, 1) * turn(rpy.y(), 2, 0) * turn(rpy.x(), 1, 2);
  pose.translation() = xyz;
  return pose;
}

Eigen::Isometry3d origin_of(const Element& element) {
  const Element* const origin = element.FirstChildElement("origin");
  if (origin == nullptr) return Eigen::Isometry3d::Identity();
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  return pose_from(vector_of(*origin, "xyz", zero), vector_of(*origin, "rpy", zero));
}

}  // namespace programs::models
