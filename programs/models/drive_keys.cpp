#include "programs/models/drive_keys.h"

#include "hal/files/config/mapping.h"
#include "hal/files/config/problems.h"
#include "hal/files/config/yaml.h"

namespace programs::models {
namespace {

using hal::files::config::Key;
using hal::files::config::Mapping;

std::vector<std::string> names_of(Mapping& in, const Key& key) {
  if (in.has_scalar(key.name)) return {in.text(key)};
  std::vector<std::string> names;
  for (const auto& scalar : in.texts(key)) names.push_back(scalar.text);
  return names;
}

DriveChoice choice_of(Mapping& in) {
  DriveChoice choice;
  choice.left = names_of(in, {"left", "Joints of the wheels on the left.", "wheel_left_joint"});
  choice.right = names_of(in, {"right", "Joints of the wheels on the right.", "wheel_right_joint"});
  choice.omni = names_of(in, {"omni", "Joints of omni wheels.", "[a, b, c]"});
  choice.mecanum = names_of(in, {"mecanum", "Joints of mecanum wheels.", "[a, b, c, d]"});
  choice.roller_angle =
      in.number({"roller_angle", "Angle of the rollers of mecanum wheels.", "45 deg"}, "rad",
                {0.1, 1.4}, choice.roller_angle);
  choice.casters = names_of(in, {"casters", "Links that are casters.", "caster_back_link"});
  if (choice.left.empty() != choice.right.empty())
    in.mistake(choice.left.empty() ? "left" : "right",
               "is missing: left and right belong together");
  return choice;
}

}  // namespace

DriveChoice parse_drive(const std::string& text) {
  using namespace hal::files::config;
  std::vector<Problem> found;
  std::size_t values = 10'000;
  const Node node = parse_yaml(text, {0, "drive", 0, 0, Layer::kCommandLine}, found, values);
  if (!found.empty()) throw DriveError("drive", found.front().what);
  if (node.kind != Node::Kind::kMapping) throw DriveError("drive", "must be a mapping");
  Problems problems;
  Mapping in(node, "", problems);
  DriveChoice choice = choice_of(in);
  in.finish();
  if (problems.none()) return choice;
  // "place: key: what"; the place is that of the caller.
  const std::string first = problems.messages().front();
  const std::size_t colon = first.find(": ");
  const std::string rest = colon == std::string::npos ? first : first.substr(colon + 2);
  const std::size_t end = rest.find(": ");
  if (end == std::string::npos) throw DriveError("drive", rest);
  throw DriveError("drive." + rest.substr(0, end), rest.substr(end + 2));
}

}  // namespace programs::models
