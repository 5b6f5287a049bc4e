#include "programs/models/sdf_plugins.h"

#include <fmt/format.h>

#include <initializer_list>

namespace programs::models {
namespace {

using ::sdf::ElementPtr;

bool is_diff_drive(const std::string& filename, const std::string& name) {
  const auto has = [&](const char* part) { return filename.find(part) != std::string::npos; };
  return has("diff_drive") || has("diff-drive") || has("DiffDrive") ||
         name.ends_with("::DiffDrive");
}

std::vector<std::string> texts(const ElementPtr& plugin, std::initializer_list<const char*> keys) {
  std::vector<std::string> all;
  for (const char* const key : keys) {
    if (!plugin->HasElement(key)) continue;
    for (ElementPtr one = plugin->GetElement(key); one; one = one->GetNextElement(key))
      all.push_back(one->Get<std::string>());
  }
  return all;
}

std::optional<double> positive(const ElementPtr& plugin, std::initializer_list<const char*> keys) {
  for (const char* const key : keys) {
    if (!plugin->HasElement(key)) continue;
    const auto [value, is_number] = plugin->GetElement(key)->Get<double>("", 0.0);
    if (is_number && value > 0) return value;
  }
  return std::nullopt;
}

DiffDrive drive_of(const ElementPtr& plugin) {
  DiffDrive drive;
  drive.left = texts(plugin, {"left_joint", "leftJoint"});
  drive.right = texts(plugin, {"right_joint", "rightJoint"});
  drive.wheel_radius = positive(plugin, {"wheel_radius"});
  if (const auto across = positive(plugin, {"wheel_diameter", "wheelDiameter"}))
    drive.wheel_radius = *across / 2;
  drive.effort = positive(plugin, {"max_wheel_torque", "wheelTorque", "torque"});
  drive.speed = positive(plugin, {"max_linear_velocity", "max_velocity"});
  drive.acceleration = positive(plugin, {"max_linear_acceleration"});
  drive.line = plugin->LineNumber().value_or(0);
  return drive;
}

}  // namespace

void add_plugins(const ElementPtr& model, Model& to) {
  if (!model || !model->HasElement("plugin")) return;
  for (ElementPtr one = model->GetElement("plugin"); one; one = one->GetNextElement("plugin")) {
    const auto filename = one->Get<std::string>("filename");
    const auto name = one->Get<std::string>("name");
    if (is_diff_drive(filename, name) && !to.drive) {
      to.drive = drive_of(one);
      continue;
    }
    to.notes.push_back({one->LineNumber().value_or(0), fmt::format("<plugin> '{}'", name)});
  }
}

}  // namespace programs::models
