#include "results/capsule/archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <array>
#include <fstream>
#include <stdexcept>

namespace results::capsule {
namespace {

namespace fs = std::filesystem;

constexpr int kPlain = 0644;
constexpr int kExecutable = 0755;

}  // namespace

Archive::Archive(const fs::path& file) : file_(file), archive_(archive_write_new()) {
  archive_write_set_format_pax_restricted(archive_);
  if (archive_write_add_filter_zstd(archive_) != ARCHIVE_OK ||
      archive_write_open_filename(archive_, file.c_str()) != ARCHIVE_OK) {
    const std::string why = archive_error_string(archive_);
    archive_write_free(archive_);
    throw std::runtime_error(fmt::format("{}: {}", file.string(), why));
  }
}

Archive::~Archive() { archive_write_free(archive_); }

void Archive::fail() const {
  throw std::runtime_error(fmt::format("{}: {}", file_.string(), archive_error_string(archive_)));
}

void Archive::begin(const std::string& name, std::int64_t size, bool executable) {
  archive_entry* const entry = archive_entry_new();
  archive_entry_set_pathname_utf8(entry, name.c_str());
  archive_entry_set_size(entry, size);
  archive_entry_set_filetype(entry, AE_IFREG);
  archive_entry_set_perm(entry, executable ? kExecutable : kPlain);
  archive_entry_set_mtime(entry, 0, 0);
  const int written = archive_write_header(archive_, entry);
  archive_entry_free(entry);
  if (written != ARCHIVE_OK) fail();
}

void Archive::write(const char* data, std::size_t size) {
  if (archive_write_data(archive_, data, size) != static_cast<la_ssize_t>(size)) fail();
}

void Archive::add(const std::string& name, std::string_view content, bool executable) {
  begin(name, static_cast<std::int64_t>(content.size()), executable);
  write(content.data(), content.size());
}

void Archive::add_file(const std::string& name, const fs::path& file) {
  constexpr std::size_t kBlock = std::size_t{1} << 20U;
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
  const bool executable = (fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms{};
  begin(name, static_cast<std::int64_t>(fs::file_size(file)), executable);
  std::string block(kBlock, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(kBlock)) || in.gcount() > 0) {
    write(block.data(), static_cast<std::size_t>(in.gcount()));
  }
}

void Archive::close() {
  if (archive_write_close(archive_) != ARCHIVE_OK) fail();
}

}  // namespace results::capsule
