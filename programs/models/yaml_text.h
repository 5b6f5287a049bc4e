#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "programs/models/model.h"

namespace programs::models {

/// A number that reads back to the same bits, with its unit; lists of such numbers.
std::string value(double number, std::string_view unit);
std::string list(std::initializer_list<double> numbers, std::string_view unit);
std::string list(const Eigen::Vector2d& v, std::string_view unit);
std::string list(const Eigen::Vector3d& v, std::string_view unit);

/// The end of a line: where the model has what is on it.
std::string at_line(Line line);

std::string quoted(const std::string& text);

/// What comes first: the file, and what is left out.
std::string header(const std::string& file, std::vector<Note> notes);

/// A name of letters, digits and '_' that begins with a letter. @param kind  comes first if it must
std::string plain_name(const std::string& name, const std::string& kind);
/// The name, or with the first number that makes it another one. @param taken  receives it
std::string name_of_its_own(const std::string& name, std::set<std::string>& taken);

/// Items of a mapping in flow style, of those that are there.
class Flow {
 public:
  Flow& add(std::string_view key, const std::string& text);
  Flow& add(std::string_view key, const std::optional<double>& number, std::string_view unit);
  bool is_empty() const { return text_.empty(); }
  std::string text() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

}  // namespace programs::models
