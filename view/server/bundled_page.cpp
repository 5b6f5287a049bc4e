#include "view/server/bundled_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "hal/files/config/shared_folders.h"

namespace view::server {
namespace {

std::filesystem::path place_of(const std::string& name) {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return hal::files::config::find_shared(name).value_or(folder / name);
}

}  // namespace

std::optional<std::string> find_page(const std::string& name) {
  std::ifstream file(place_of(name), std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string bundled_page(const std::string& name, const std::string& advice) {
  if (auto page = find_page(name)) return std::move(*page);
  throw std::runtime_error(fmt::format("{} is missing, and no {} is in {}: {}",
                                       place_of(name).string(), name,
                                       hal::files::config::listed_shared_folders(), advice));
}

}  // namespace view::server
