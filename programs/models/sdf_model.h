#pragma once

#include <Eigen/Geometry>
#include <sdf/sdf.hh>
#include <string>
#include <utility>

#include "programs/models/model.h"
#include "programs/models/search_path.h"

namespace programs::models {

/// Lines of one file; elements of others, which it includes, have none.
class Lines {
 public:
  explicit Lines(std::string file) : file_(std::move(file)) {}
  Line of(const ::sdf::ElementPtr& element) const {
    return element && element->FilePath() == file_ ? element->LineNumber().value_or(0) : 0;
  }

 private:
  std::string file_;
};

/// @param otherwise  line of errors that have none. @throws ModelError  the first error
void check(const ::sdf::Errors& errors, Line otherwise);

/// A pose in the frame `to`; empty: that of what has the pose. @throws ModelError
Eigen::Isometry3d resolved(const ::sdf::SemanticPose& semantic, const std::string& to, Line line);

/// What a model of libsdformat holds, with models inside it.
/// @param pose  of the model in the frame of the result. @throws ModelError
Model model_of(const ::sdf::Model& from, const Eigen::Isometry3d& pose, const SearchPath& search,
               const Lines& lines);

}  // namespace programs::models
