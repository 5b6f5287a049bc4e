#include "programs/models/sdf_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "programs/models/sdf_model.h"

namespace programs::models {
namespace {

/// The root, which is no child, comes first.
void put_root_first(Model& model) {
  const auto is_child = [&](const ModelLink& link) {
    return std::ranges::any_of(model.joints,
                               [&](const Joint& joint) { return joint.child == link.name; });
  };
  const auto root = std::ranges::find_if_not(model.links, is_child);
  if (root == model.links.end()) throw ModelError(model.line, "no link is the root of the joints");
  std::rotate(model.links.begin(), root, root + 1);
}

/// @return lines of the file
Lines load(::sdf::Root& root, const std::filesystem::path& file, const SearchPath& search) {
  ::sdf::Console::Instance()->SetQuiet(true);
  ::sdf::ParserConfig config;
  config.SetFindCallback([&search](const std::string& uri) {
    const auto found = search.find(uri);
    return found ? found->string() : std::string();
  });
  const std::string name = std::filesystem::absolute(file).string();
  check(root.Load(name, config), 0);
  return Lines(name);
}

std::vector<const ::sdf::Model*> models_of(const ::sdf::Root& root) {
  std::vector<const ::sdf::Model*> all;
  if (root.Model() != nullptr) all.push_back(root.Model());
  for (std::uint64_t w = 0; w < root.WorldCount(); ++w)
    for (std::uint64_t i = 0; i < root.WorldByIndex(w)->ModelCount(); ++i)
      all.push_back(root.WorldByIndex(w)->ModelByIndex(i));
  return all;
}

}  // namespace

Model read_sdf(const std::filesystem::path& file, const std::string& name,
               const SearchPath& search) {
  ::sdf::Root root;
  const Lines lines = load(root, file, search);
  std::vector<std::string> names;
  std::vector<const ::sdf::Model*> found;
  for (const ::sdf::Model* const one : models_of(root)) {
    names.push_back(one->Name());
    if (name.empty() || one->Name() == name) found.push_back(one);
  }
  if (found.size() != 1)
    throw ModelError(1, fmt::format("{}; models here: {}",
                                    name.empty() ? std::string("sdf_model must name one model")
                                                 : fmt::format("has no one model '{}'", name),
                                    fmt::join(names, ", ")));
  Model model = model_of(*found.front(), {}, search, lines);
  put_root_first(model);
  return model;
}

WorldModels read_sdf_world(const std::filesystem::path& file, const SearchPath& search) {
  ::sdf::Root root;
  const Lines lines = load(root, file, search);
  if (root.WorldCount() != 1)
    throw ModelError(1, fmt::format("has {} worlds, not one", root.WorldCount()));
  const ::sdf::World& world = *root.WorldByIndex(0);
  WorldModels all;
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    const ::sdf::Model& one = *world.ModelByIndex(i);
    const Line line = lines.of(one.Element());
    all.models.push_back(
        {model_of(one, {resolved(one.SemanticPose(), "", line), true}, search, lines),
         one.Static()});
  }
  for (std::uint64_t i = 0; i < world.ActorCount(); ++i)
    all.notes.push_back({lines.of(world.ActorByIndex(i)->Element()),
                         fmt::format("<actor> '{}'", world.ActorByIndex(i)->Name())});
  if (world.LightCount() > 0)
    all.notes.push_back({lines.of(world.LightByIndex(0)->Element()), "lights"});
  return all;
}

}  // namespace programs::models
