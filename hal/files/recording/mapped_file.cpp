#include "hal/files/recording/mapped_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "hal/types/printable.h"

namespace hal::files::recording {

MappedFile::MappedFile(const std::filesystem::path& path) : name_(printable(path.string())) {
  const auto fail = [this](std::string_view why) {
    throw std::runtime_error(fmt::format("{}: cannot be read: {}", name_, why));
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) fail(std::strerror(errno));
  struct stat status {};
  const bool is_file = ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
  const auto size = static_cast<std::size_t>(is_file ? status.st_size : 0);
  void* const mapped =
      size == 0 ? nullptr : ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  const int error = errno;
  ::close(descriptor);
  if (!is_file) fail("it is not a regular file");
  if (mapped == MAP_FAILED) fail(std::strerror(error));
  octets_ = {static_cast<const std::byte*>(mapped), size};
}

MappedFile::~MappedFile() {
  if (!octets_.empty()) ::munmap(const_cast<std::byte*>(octets_.data()), octets_.size());
}

}  // namespace hal::files::recording
