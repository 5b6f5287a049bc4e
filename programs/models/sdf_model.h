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

/// Where a model is.
struct ModelPlace {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< In the frame of the result.
  bool is_in_world = false;  ///< And not a robot, of which links without a mass are noted.
};

/// What a model of libsdformat holds, with models inside it. @throws ModelError
Model model_of(const ::sdf::Model& from, const ModelPlace& place, const SearchPath& search,
               const Lines& lines);

}  // namespace programs::models
