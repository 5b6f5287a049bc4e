// Entropy: getrandom(2), random(4); getentropy(3), arc4random(3); what the C++ library draws for
// std::random_device. Repeatable: from the seed of the run.
#include "programs/waits/entropy.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/turn.h"

namespace programs::waits {
namespace {

constexpr std::uint64_t kStep = 0x9e37'79b9'7f4a'7c15;

std::atomic<std::uint64_t> state = 0;
std::atomic<bool> has_begun = false;

std::uint64_t mixed(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58'476d'1ce4'e5b9;
  value = (value ^ (value >> 27)) * 0x94d0'49bb'1331'11eb;
  return value ^ (value >> 31);
}

/// By which the files below are known: no other file in memory has this seal alone.
constexpr int kSeal = F_SEAL_SHRINK;

void fill(int file) {
  constexpr std::size_t kBytes = 16'384, kAtATime = 4096;
  std::array<std::uint8_t, kAtATime> bytes{};
  for (std::size_t done = 0; done < kBytes; done += kAtATime) {
    draw(bytes.data(), bytes.size());
    (void)!pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(done));
  }
}

}  // namespace

void draw_anew() { has_begun = false; }

std::uint64_t draw() {
  if (!has_begun.exchange(true)) {
    state = mixed(page()->seed.load() + kStep * (page()->drawn.fetch_add(1) + 1));
  }
  return mixed(state.fetch_add(kStep) + kStep);
}

bool is_refilled(int descriptor) {
  const int kept = errno;
  const bool is_drawn = fcntl(descriptor, F_GET_SEALS) == kSeal;
  errno = kept;
  if (!is_drawn) return false;
  fill(descriptor);
  return lseek(descriptor, 0, SEEK_SET) == 0;
}

void draw(void* bytes, std::size_t count) {
  auto* const to = static_cast<std::uint8_t*>(bytes);
  for (std::size_t i = 0; i < count; i += sizeof(std::uint64_t)) {
    const std::uint64_t drawn = draw();
    std::memcpy(to + i, &drawn, count - i < sizeof drawn ? count - i : sizeof drawn);
  }
}

bool is_random_device(const char* path) {
  return path != nullptr && own_slot() != nullptr &&
         (std::strcmp(path, "/dev/urandom") == 0 || std::strcmp(path, "/dev/random") == 0);
}

/// A file in memory, which is_refilled() makes endless.
int open_drawn(int flags) {
  const unsigned kept = (flags & O_CLOEXEC) != 0 ? MFD_CLOEXEC : 0;
  const int file = memfd_create("random", kept | MFD_ALLOW_SEALING);
  if (file < 0) return file;
  fill(file);
  fcntl(file, F_ADD_SEALS, kSeal);
  return file;
}

}  // namespace programs::waits

using programs::waits::own_slot;

BARAKA_EXPORTED ssize_t getrandom(void* bytes, size_t count, unsigned flags) {
  if (own_slot() == nullptr) return BARAKA_NEXT(getrandom)(bytes, count, flags);
  programs::waits::draw(bytes, count);
  return static_cast<ssize_t>(count);
}

BARAKA_EXPORTED int getentropy(void* bytes, size_t count) {
  constexpr size_t kMost = 256;
  if (own_slot() == nullptr || count > kMost) return BARAKA_NEXT(getentropy)(bytes, count);
  programs::waits::draw(bytes, count);
  return 0;
}

BARAKA_EXPORTED std::uint32_t arc4random() noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(arc4random)();
  return static_cast<std::uint32_t>(programs::waits::draw() >> 32);
}

BARAKA_EXPORTED void arc4random_buf(void* bytes, size_t count) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(arc4random_buf)(bytes, count);
  programs::waits::draw(bytes, count);
}

extern "C" {
/// std::random_device::_M_getval() of libstdc++, which asks the processor.
unsigned random_device_value(void* device) __asm__("_ZNSt13random_device9_M_getvalEv");
}

BARAKA_EXPORTED unsigned random_device_value(void* device) {
  using Next = unsigned (*)(void*);
  static constinit programs::preload::Intercepted next("_ZNSt13random_device9_M_getvalEv");
  if (own_slot() == nullptr) return reinterpret_cast<Next>(next.find())(device);
  return static_cast<unsigned>(programs::waits::draw() >> 32);
}
