#include "hal/files/config/paths_beside.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "hal/files/config/document_limits.h"
#include "hal/files/config/yaml.h"

namespace hal::files::config {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kPathKeys = {"file", "from", "include", "profile"};

bool is_beside(std::string_view key, const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) || (key == "from" && fs::is_directory(path, error));
}

void make_absolute(std::string_view key, Node& node, const fs::path& folder) {
  for (Node& item : node.items) make_absolute(key, item, folder);
  for (Entry& entry : node.entries) make_absolute(entry.key, entry.value, folder);
  if (node.kind != Node::Kind::kScalar || node.text.empty()) return;
  if (std::ranges::find(kPathKeys, key) == kPathKeys.end()) return;
  const fs::path path = folder / node.text;  // an absolute text stays as it is
  if (is_beside(key, path)) node.text = fs::absolute(path).lexically_normal().string();
}

}  // namespace

std::string with_paths_beside(const std::string& key, const std::string& yaml,
                              const fs::path& folder) {
  std::vector<Problem> problems;
  std::size_t values_left = kMostValues;
  Node node = parse_yaml(yaml, {}, problems, values_left);
  if (!problems.empty()) return yaml;  // to be reported by the reader of the override
  make_absolute(std::string_view(key).substr(key.rfind('.') + 1), node, folder);
  return flow_yaml(node);
}

}  // namespace hal::files::config
