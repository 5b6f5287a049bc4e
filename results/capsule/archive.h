#pragma once

#include <filesystem>
#include <string>
#include <string_view>

struct archive;

namespace results::capsule {

/// A tar archive compressed by Zstandard, by libarchive. Equal entries give equal bytes: times are
/// 0, owners root. Every member throws std::runtime_error with the file and libarchive's reason.
class Archive {
 public:
  explicit Archive(const std::filesystem::path& file);
  ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// @param name  of the entry, with '/' between folders.
  void add(const std::string& name, std::string_view content, bool executable = false);
  void add_file(const std::string& name, const std::filesystem::path& file);
  /// Writes what is left. Nothing may be added afterwards.
  void close();

 private:
  void begin(const std::string& name, std::int64_t size, bool executable);
  void write(const char* data, std::size_t size);
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  ::archive* archive_;
};

}  // namespace results::capsule
