#include "programs/models/urdf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <utility>

#include "programs/models/mesh.h"
#include "programs/models/xacro.h"
#include "programs/models/xml.h"

namespace programs::models {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A joint as the file has it: its pose is in the parent's frame.
struct Mounted {
  Joint joint;
  Isometry3d origin;
  Vector3d axis;  ///< In the joint's frame.
};

/// Elements of one kind in a file, and what of them is noted once.
class UrdfReader {
 public:
  explicit UrdfReader(const SearchPath& search) : search_(search) {}
  Model read(const Element& robot);

 private:
  void note(const Element& element, const std::string& what) {
    model_.notes.push_back({element.GetLineNum(), what});
  }
  void add(const Element& element);
  void add_link(const Element& element);
  void add_joint(const Element& element);
  Inertial inertial_of(const Element& element) const;
  Shape mesh_of(const Element& element) const;
  Shape shape_of(const Element& element) const;
  std::set<std::string> children() const;
  void place_links();
  void place(const std::string& parent, const Isometry3d& pose);

  const SearchPath& search_;
  Model model_;
  std::vector<Mounted> mounted_;
  std::vector<ModelLink> placed_;
  bool notes_visuals_ = true;
};

double positive(const Element& element, const char* attribute) {
  const double value = number_of(element, attribute);
  if (value > 0) return value;
  throw ModelError(element.GetLineNum(),
                   fmt::format("{}: {}: {} must be more than 0", title(element), attribute, value));
}

Inertial UrdfReader::inertial_of(const Element& element) const {
  const Element* const mass = element.FirstChildElement("mass");
  const Element* const inertia = element.FirstChildElement("inertia");
  if (mass == nullptr || inertia == nullptr)
    throw ModelError(element.GetLineNum(),
                     fmt::format("<inertial> has no <{}>", mass == nullptr ? "mass" : "inertia"));
  const Isometry3d origin = origin_of(element);
  const auto entry = [&](const char* name) { return number_of(*inertia, name); };
  // Read before they are put in: a matrix that is only half there does not survive an exception.
  const double xx = entry("ixx"), xy = entry("ixy"), xz = entry("ixz");
  const double yy = entry("iyy"), yz = entry("iyz"), zz = entry("izz");
  Eigen::Matrix3d own;
  own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  return {positive(*mass, "value"), origin.translation(),
          origin.linear() * own * origin.linear().transpose(), inertia->GetLineNum()};
}

Shape UrdfReader::mesh_of(const Element& element) const {
  const std::string name = text_of(element, "filename");
  const auto file = search_.find(name);
  if (!file)
    throw ModelError(
        element.GetLineNum(),
        fmt::format("there is no mesh '{}' in the search path: {}", name, search_.listed()));
  try {
    return {.kind = Shape::Kind::kPoints,
            .points = mesh_points(*file, vector_of(element, "scale", Vector3d::Ones()))};
  } catch (const ModelError&) {
    throw;
  } catch (const std::exception& error) {
    throw ModelError(element.GetLineNum(), fmt::format("'{}' {}", file->string(), error.what()));
  }
}

Shape UrdfReader::shape_of(const Element& collision) const {
  const Element* const geometry = collision.FirstChildElement("geometry");
  const Element* const one = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (one == nullptr)
    throw ModelError(collision.GetLineNum(), fmt::format("{} has no shape", title(collision)));
  const std::string kind = one->Name();
  if (kind == "box") {
    const Vector3d size = vector_of(*one, "size", Vector3d::Zero());
    if (!(size.minCoeff() > 0))
      throw ModelError(one->GetLineNum(), "<box>: size: must be three lengths above 0");
    return {.kind = Shape::Kind::kBox, .size = size};
  }
  if (kind == "cylinder" || kind == "capsule") {
    return {.kind = kind == "cylinder" ? Shape::Kind::kCylinder : Shape::Kind::kCapsule,
            .radius = positive(*one, "radius"),
            .length = positive(*one, "length")};
  }
  if (kind == "sphere") return {.kind = Shape::Kind::kSphere, .radius = positive(*one, "radius")};
  if (kind == "mesh") return mesh_of(*one);
  throw ModelError(one->GetLineNum(),
                   fmt::format("<{}> is not a shape of URDF: box, cylinder, sphere or mesh", kind));
}

void UrdfReader::add_link(const Element& element) {
  ModelLink link{.name = text_of(element, "name"),
                 .pose = Isometry3d::Identity(),
                 .line = element.GetLineNum()};
  if (named(model_.links, link.name) != nullptr)
    throw ModelError(link.line, fmt::format("there are two links '{}'", link.name));
  for (const Element* one = element.FirstChildElement(); one != nullptr;
       one = one->NextSiblingElement()) {
    const std::string kind = one->Name();
    if (kind == "inertial") {
      if (link.inertial)
        throw ModelError(one->GetLineNum(), title(element) + " has two <inertial>");
      link.inertial = inertial_of(*one);
    } else if (kind == "collision") {
      const char* const name = one->Attribute("name");
      link.collisions.push_back({.name = name == nullptr ? link.name : name,
                                 .pose = origin_of(*one),
                                 .shape = shape_of(*one),
                                 .line = one->GetLineNum()});
    } else if (kind != "visual") {
      note(*one, fmt::format("<{}> of the link '{}'", kind, link.name));
    } else if (std::exchange(notes_visuals_, false)) {
      note(*one, "visual shapes: viewers draw those of collisions");
    }
  }
  model_.links.push_back(std::move(link));
}

void UrdfReader::add_joint(const Element& element) {
  const auto link_of = [&](const char* which) {
    const Element* const one = element.FirstChildElement(which);
    if (one == nullptr)
      throw ModelError(element.GetLineNum(), fmt::format("{} has no <{}>", title(element), which));
    return text_of(*one, "link");
  };
  Joint joint{.name = text_of(element, "name"),
              .type = text_of(element, "type"),
              .parent = link_of("parent"),
              .child = link_of("child"),
              .line = element.GetLineNum()};
  for (const Mounted& other : mounted_)
    if (other.joint.name == joint.name)
      throw ModelError(joint.line, fmt::format("there are two joints '{}'", joint.name));
  static const std::set<std::string> types_of_joints{"fixed",     "revolute", "continuous",
                                                     "prismatic", "floating", "planar"};
  if (!types_of_joints.contains(joint.type))
    throw ModelError(joint.line, fmt::format("{}: '{}' is not a type of joint: {}", title(element),
                                             joint.type, fmt::join(types_of_joints, ", ")));
  const Element* const along = element.FirstChildElement("axis");
  const Vector3d axis =
      along == nullptr ? Vector3d::UnitX() : vector_of(*along, "xyz", Vector3d::UnitX());
  if (!(axis.norm() > 1e-6))
    throw ModelError(along->GetLineNum(),
                     fmt::format("{}: its axis has no direction", title(element)));
  if (const Element* const limit = element.FirstChildElement("limit")) {
    joint.effort = number_if_there(*limit, "effort");
    joint.velocity = number_if_there(*limit, "velocity");
  }
  for (const char* const left : {"mimic", "safety_controller", "calibration", "dynamics"})
    if (const Element* const one = element.FirstChildElement(left))
      note(*one, fmt::format("<{}> of the joint '{}'", left, joint.name));
  mounted_.push_back({std::move(joint), origin_of(element), axis.normalized()});
}

void UrdfReader::add(const Element& element) {
  const std::string kind = element.Name();
  if (kind == "link") return add_link(element);
  if (kind == "joint") return add_joint(element);
  if (kind == "material") return;  // of visual shapes
  const char* const of = element.Attribute("reference");
  const char* const name = of == nullptr ? element.Attribute("name") : of;
  note(element, fmt::format("<{}>{}", kind, name == nullptr ? "" : fmt::format(" '{}'", name)));
}

void UrdfReader::place(const std::string& parent, const Isometry3d& pose) {
  const ModelLink& link = *named(model_.links, parent);
  placed_.push_back(link);
  placed_.back().pose = pose;
  for (const Mounted& one : mounted_) {
    if (one.joint.parent != parent) continue;
    const Isometry3d at = pose * one.origin;
    Joint joint = one.joint;
    joint.axis = at.linear() * one.axis;
    joint.origin = at.translation();
    model_.joints.push_back(std::move(joint));
    place(one.joint.child, at);
  }
}

/// The children of all joints, each of which has two links of the file.
std::set<std::string> UrdfReader::children() const {
  std::set<std::string> children;
  for (const Mounted& one : mounted_) {
    for (const std::string& name : {one.joint.parent, one.joint.child})
      if (named(model_.links, name) == nullptr)
        throw ModelError(one.joint.line,
                         fmt::format("<joint> '{}': there is no link '{}'", one.joint.name, name));
    if (!children.insert(one.joint.child).second)
      throw ModelError(one.joint.line,
                       fmt::format("the link '{}' is the child of two joints", one.joint.child));
  }
  return children;
}

/// A tree: each link but the root is the child of one joint.
void UrdfReader::place_links() {
  const std::set<std::string> inner = children();
  std::vector<const ModelLink*> roots;
  for (const ModelLink& link : model_.links)
    if (!inner.contains(link.name)) roots.push_back(&link);
  if (roots.size() > 1)
    throw ModelError(roots[1]->line, fmt::format("no joint connects the link '{}' with '{}'",
                                                 roots[1]->name, roots[0]->name));
  if (roots.empty()) throw ModelError(model_.line, "the joints form a circle: there is no root");
  place(roots.front()->name, Isometry3d::Identity());
  for (const ModelLink& link : model_.links)
    if (named(placed_, link.name) == nullptr)
      throw ModelError(link.line, fmt::format("the link '{}' is in a circle of joints", link.name));
  model_.links = std::move(placed_);
}

Model UrdfReader::read(const Element& robot) {
  if (std::string(robot.Name()) != "robot")
    throw ModelError(robot.GetLineNum(),
                     fmt::format("<{}> is not URDF, whose first element is <robot>", robot.Name()));
  model_.name = text_of(robot, "name");
  model_.line = robot.GetLineNum();
  for (const Element* one = robot.FirstChildElement(); one != nullptr;
       one = one->NextSiblingElement())
    add(*one);
  if (model_.links.empty()) throw ModelError(model_.line, "the robot has no link");
  place_links();
  return std::move(model_);
}

}  // namespace

Model parse_urdf(const std::string& text, const SearchPath& search) {
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS)
    throw ModelError(document.ErrorLineNum(), fmt::format("is not XML: {}", document.ErrorName()));
  if (document.RootElement() == nullptr) throw ModelError(1, "has no element");
  return UrdfReader(search).read(*document.RootElement());
}

Model read_urdf(const std::filesystem::path& file, const SearchPath& search) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw ModelError(0, "cannot be read");
  if (const auto line = first_of_xacro(text)) text = expanded_by_xacro(file, *line);
  return parse_urdf(text, search);
}

}  // namespace programs::models
