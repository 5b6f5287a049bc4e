#include "programs/netns/shown.h"

#include <fcntl.h>
#include <sys/mount.h>
#include <sys/stat.h>

#include <algorithm>
#include <string>

namespace programs::netns {
namespace {

bool is_beneath(const std::filesystem::path& folder, const std::filesystem::path& path) {
  const auto [end, unused] = std::ranges::mismatch(folder, path);
  return end == folder.end() && path != folder;
}

/// Whether a path is inside one of kOwnFolders, and not such a folder itself.
bool is_hidden(const std::filesystem::path& path) {
  return std::ranges::any_of(kOwnFolders, [&path](const char* one) {
    std::error_code error;
    const auto folder = std::filesystem::canonical(one, error);
    return !error && path != folder && path != one &&
           (is_beneath(folder, path) || is_beneath(one, path));
  });
}

void make_place(const std::filesystem::path& path, bool is_folder) {
  std::error_code error;
  std::filesystem::create_directories(is_folder ? path : path.parent_path(), error);
  if (!is_folder) FileDescriptor(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644)).reset();
}

/// The two names of a file: without symbolic links, and as it was given.
std::array<std::filesystem::path, 2> names_of(const std::filesystem::path& path) {
  std::error_code error;
  auto given = std::filesystem::absolute(path).lexically_normal();
  if (!given.has_filename()) given = given.parent_path();  // "/tmp/"
  return {std::filesystem::canonical(path, error), given};
}

}  // namespace

void Shown::add(const std::filesystem::path& path) {
  for (const std::filesystem::path& name : names_of(path)) {
    struct stat status {};
    if (!is_hidden(name) || stat(name.c_str(), &status) != 0) continue;
    FileDescriptor mount(
        open_tree(AT_FDCWD, name.c_str(), OPEN_TREE_CLONE | OPEN_TREE_CLOEXEC | AT_RECURSIVE));
    if (!mount.is_open()) fail(name.string() + " cannot be shown inside an agent");
    trees_.push_back(
        {name, std::move(mount), S_ISDIR(status.st_mode), status.st_dev, status.st_ino});
  }
}

void Shown::add_folder_of(const std::filesystem::path& file) {
  for (const std::filesystem::path& name : names_of(file)) {
    add(is_hidden(name.parent_path()) ? name.parent_path() : name);
  }
}

void Shown::put() const {
  for (const Tree& tree : trees_) {
    struct stat status {};
    const bool is_there = stat(tree.path.c_str(), &status) == 0 && status.st_dev == tree.device &&
                          status.st_ino == tree.number;
    if (is_there) continue;
    make_place(tree.path, tree.is_folder);
    if (move_mount(tree.mount.get(), "", AT_FDCWD, tree.path.c_str(), MOVE_MOUNT_F_EMPTY_PATH) !=
        0) {
      fail(tree.path.string() + " cannot be shown inside an agent");
    }
  }
}

}  // namespace programs::netns
