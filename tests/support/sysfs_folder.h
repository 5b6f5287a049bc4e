#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace tests {

/// A folder of attributes like a device's in sysfs, which goes with this object.
class SysfsFolder {
 public:
  SysfsFolder() {
    std::string path = std::filesystem::temp_directory_path() / "baraka_sysfs_XXXXXX";
    path_ = ::mkdtemp(path.data());
  }
  ~SysfsFolder() { std::filesystem::remove_all(path_); }
  SysfsFolder(const SysfsFolder&) = delete;
  SysfsFolder& operator=(const SysfsFolder&) = delete;

  void set(const std::string& attribute, const std::string& value) const {
    const std::filesystem::path fresh = path_ / (attribute + ".new");
    std::ofstream(fresh) << value << '\n';
    std::filesystem::rename(fresh, path_ / attribute);  // as sysfs: never half of a value
  }
  void remove(const std::string& attribute) const { std::filesystem::remove(path_ / attribute); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tests
