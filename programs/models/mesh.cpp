#include "programs/models/mesh.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <stdexcept>

namespace programs::models {
namespace {

using Points = std::vector<Eigen::Vector3d>;

void add_points(const aiScene& scene, const aiNode& node, const aiMatrix4x4& outer,
                const Eigen::Vector3d& scale, Points& points) {
  const aiMatrix4x4 pose = outer * node.mTransformation;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) {
      const aiVector3D at = pose * mesh.mVertices[k];
      points.emplace_back(scale.cwiseProduct(Eigen::Vector3d(at.x, at.y, at.z)));
      if (!points.back().allFinite()) throw std::runtime_error("has a corner that is not finite");
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    add_points(scene, *node.mChildren[i], pose, scale, points);
}

}  // namespace

Points mesh_points(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  Assimp::Importer importer;
  // As ROS and Gazebo do: z of the file is z of the link, whatever it calls up.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_JoinIdenticalVertices);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw std::runtime_error("is not a mesh: " + std::string(importer.GetErrorString()));
  Points points;
  add_points(*scene, *scene->mRootNode, aiMatrix4x4(), scale, points);
  if (points.empty()) throw std::runtime_error("is a mesh without corners");
  return points;
}

}  // namespace programs::models
