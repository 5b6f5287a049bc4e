#include "baraka/commands/output_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace baraka::commands {
namespace {

namespace fs = std::filesystem;

/// Permissions of the file: those of an existing file, otherwise those that the process gives to
/// new files.
mode_t permissions_of(const std::string& file) {
  struct stat known {};
  if (::stat(file.c_str(), &known) == 0) return known.st_mode & 07777U;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666U & ~mask;
}

/// Resolves links; a name that does not exist stays as it is.
std::string target_of(const std::string& file) {
  std::error_code error;
  const fs::path target = fs::weakly_canonical(file, error);
  return error ? file : target.string();
}

bool is_written_in_place(const std::string& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  return fs::exists(status) && !fs::is_regular_file(status);
}

}  // namespace

OutputFile::OutputFile(const std::string& file) : name_(file.empty() ? "standard output" : file) {
  if (file.empty()) return;
  if (is_written_in_place(file)) {
    file_.reset(std::fopen(file.c_str(), "wb"));
    if (!file_) fail();
    return;
  }
  target_ = target_of(file);
  const fs::path path(target_);
  written_ = (path.parent_path() / fmt::format(".{}.XXXXXX", path.filename().string())).string();
  const int descriptor = ::mkstemp(written_.data());
  if (descriptor < 0) {
    written_.clear();
    fail();
  }
  file_.reset(::fdopen(descriptor, "wb"));
  if (::fchmod(descriptor, permissions_of(target_)) != 0) fail();
}

OutputFile::~OutputFile() {
  if (!written_.empty()) ::unlink(written_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stream()) != text.size()) fail();
}

void OutputFile::finish() {
  if (std::fflush(stream()) != 0) fail();
  if (written_.empty()) return;
  if (std::fclose(file_.release()) != 0) fail();
  if (::rename(written_.c_str(), target_.c_str()) != 0) fail();
  written_.clear();
}

void OutputFile::fail() const {
  const int error = errno;
  if (!written_.empty())
    ::unlink(written_.c_str());  // the destructor does not run after a failed constructor
  throw std::runtime_error(fmt::format("{}: {}", name_, std::strerror(error)));
}

void write_output(const std::string& file, std::string_view text) {
  OutputFile output(file);
  output.write(text);
  output.finish();
}

}  // namespace baraka::commands
