#include "hal/files/recording/compression.h"

#include <fmt/format.h>
#include <lz4frame.h>
#include <stdlib.h>  // mkstemp
#include <unistd.h>
#include <zstd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace hal::files::recording {
namespace {

constexpr std::uint32_t kZstdMagic = 0xfd2fb528;
constexpr std::size_t kBlock = 1U << 17U;  // largest block of zstd
/// Largest chunk of MCAP: writers make chunks of about a megabyte, or of one message.
constexpr std::uint64_t kMostChunk = 1U << 30U;

[[noreturn]] void damaged(std::string_view what) {
  throw std::runtime_error(fmt::format("cannot be decompressed: {}", what));
}

/// Takes what was decompressed, block by block.
using Sink = std::function<void(Octets)>;

void unzstd(Octets octets, const Sink& sink) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(),
                                                                     &ZSTD_freeDCtx);
  std::vector<std::byte> block(kBlock);
  ZSTD_inBuffer in{octets.data(), octets.size(), 0};
  std::size_t missing = 1;
  bool is_full = false;
  while (in.pos < in.size || is_full) {
    ZSTD_outBuffer out{block.data(), block.size(), 0};
    missing = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(missing) != 0) damaged(ZSTD_getErrorName(missing));
    is_full = out.pos == out.size && missing != 0;
    sink(Octets(block).first(out.pos));
  }
  if (missing != 0) damaged("zstd: the data end within a frame");
}

void unlz4(Octets octets, const Sink& sink) {
  LZ4F_dctx* made = nullptr;
  const std::size_t error = LZ4F_createDecompressionContext(&made, LZ4F_VERSION);
  if (LZ4F_isError(error) != 0) damaged(LZ4F_getErrorName(error));
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, &LZ4F_freeDecompressionContext);
  std::vector<std::byte> block(kBlock);
  std::size_t missing = 1;
  bool is_full = false;
  while (!octets.empty() || is_full) {
    std::size_t written = block.size(), taken = octets.size();
    missing =
        LZ4F_decompress(context.get(), block.data(), &written, octets.data(), &taken, nullptr);
    if (LZ4F_isError(missing) != 0) damaged(LZ4F_getErrorName(missing));
    octets = octets.subspan(taken);
    is_full = written == block.size() && missing != 0;
    sink(Octets(block).first(written));
  }
  if (missing != 0) damaged("lz4: the data end within a frame");
}

/// @return a new file for the result, open.
int temporary_file(std::string& name) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  name = (error ? std::filesystem::path("/tmp") : folder) / "baraka-recording-XXXXXX";
  const int descriptor = ::mkstemp(name.data());
  if (descriptor < 0)
    throw std::runtime_error(fmt::format("{}: cannot be created: {}", name, std::strerror(errno)));
  return descriptor;
}

void write_all(int descriptor, Octets octets) {
  while (!octets.empty()) {
    const ssize_t written = ::write(descriptor, octets.data(), octets.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) damaged(fmt::format("no room for the result: {}", std::strerror(errno)));
    octets = octets.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace

bool is_zstd(Octets octets) {
  return rtps::Cursor(octets, rtps::Endianness::kLittle).u32() == kZstdMagic;
}

std::vector<std::byte> decompressed(std::string_view compression, Octets octets,
                                    std::uint64_t size) {
  if (size > kMostChunk)
    throw std::runtime_error(
        fmt::format("its size is {} bytes; the limit is {}", size, kMostChunk));
  std::vector<std::byte> result;
  const Sink append = [&](Octets block) {
    if (block.size() > size - result.size())
      damaged(fmt::format("there are more than the {} bytes that it announces", size));
    result.insert(result.end(), block.begin(), block.end());
  };
  if (compression == "zstd") {
    unzstd(octets, append);
  } else if (compression == "lz4") {
    unlz4(octets, append);
  } else if (compression.empty()) {
    append(octets);
  } else {
    throw std::runtime_error(
        fmt::format("its compression is '{}'; zstd, lz4 and none are known", compression));
  }
  if (result.size() != size)
    damaged(fmt::format("there are {} bytes of the {} that it announces", result.size(), size));
  return result;
}

std::uint64_t zstd_content_size(Octets frame) {
  const unsigned long long told = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (told == ZSTD_CONTENTSIZE_ERROR) damaged("zstd: the header of the frame is damaged");
  if (told != ZSTD_CONTENTSIZE_UNKNOWN) return told;
  std::uint64_t size = 0;
  unzstd(frame, [&size](Octets block) {
    size += block.size();
    if (size > std::numeric_limits<std::uint32_t>::max()) damaged("zstd: a message beyond 4 GiB");
  });
  return size;
}

DecompressedFile::DecompressedFile(const std::filesystem::path& compressed) {
  const MappedFile file(compressed);
  std::string name;
  const int descriptor = temporary_file(name);
  path_ = name;
  try {
    unzstd(file.octets(), [descriptor](Octets block) { write_all(descriptor, block); });
  } catch (const std::runtime_error& e) {
    ::close(descriptor);
    ::unlink(name.c_str());
    throw std::runtime_error(fmt::format("{}: {}", file.name(), e.what()));
  }
  ::close(descriptor);
}

DecompressedFile::~DecompressedFile() { ::unlink(path_.c_str()); }

}  // namespace hal::files::recording
