#include "programs/preload/room.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <utility>

namespace programs::preload {
namespace {

netns::RoomPage* page = nullptr;

bool is_blocking(int socket, int flags) {
  return (flags & MSG_DONTWAIT) == 0 && (fcntl(socket, F_GETFL) & O_NONBLOCK) == 0;
}

/// The places that one datagram has so far.
class Places {
 public:
  explicit Places(std::uint32_t fragments) : fragments_(fragments) {}
  ~Places() {
    forget_what_was_given_up();
    page->end_collecting(collector_);
    if (count_ != 0) return_places(count_, false);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  /// Tries to take places. @return whether it has all of them now.
  bool take() {
    forget_what_was_given_up();
    // not known before the first publish()
    const std::uint32_t wanted = page->places_for(fragments_);
    if (count_ == 0 && page->reserve(wanted)) {
      count_ = wanted;
      return true;
    }
    if (wanted <= 1) return false;
    if (collector_ == 0) collector_ = page->start_collecting();
    if (collector_ == 0) return false;
    page->still_collects();
    if (count_ < wanted) count_ += page->collect(wanted - count_);
    return count_ >= wanted;
  }
  bool is_collecting() const { return collector_ != 0; }
  /// Passes the places to the caller.
  std::uint32_t release() { return std::exchange(count_, 0); }

 private:
  /// After this process was stopped for long, its places may have been given up.
  void forget_what_was_given_up() {
    if (collector_ == 0 || page->is_collecting(collector_)) return;
    collector_ = 0;
    count_ = 0;
  }

  std::uint32_t fragments_, count_ = 0, collector_ = 0;
};

/// @param left  remaining time; negative: no limit. @return 0: try again; else the error.
int wait_for_change(std::uint32_t seen, Nanoseconds left, bool is_collecting) {
  constexpr Nanoseconds kBeat = 50'000'000;
  if (left == 0) return EAGAIN;
  const bool is_to_beat = is_collecting && (left < 0 || left > kBeat);
  const int error = wait_for_room(seen, is_to_beat ? kBeat : left);
  if (error != ETIMEDOUT) return error;
  return is_to_beat ? 0 : EAGAIN;
}

int wait_for_places(Places& places, Nanoseconds longest) {
  const Nanoseconds begin = time_of_waits();
  for (;;) {
    const std::uint32_t seen = page->change().load();
    if (places.take()) return 0;
    const Nanoseconds passed = longest < 0 ? 0 : time_of_waits() - begin;
    const Nanoseconds left = longest < 0 ? -1 : std::max<Nanoseconds>(longest - passed, 0);
    const int error = wait_for_change(seen, left, places.is_collecting());
    if (error != 0) return error;
  }
}

}  // namespace

/// Early, because programs change their root or give up the right to open files.
__attribute__((constructor)) static void map_page() {
  const char* const path = std::getenv(netns::kRoomVariable);
  if (path == nullptr) return;
  const int file = open(path, O_RDWR | O_CLOEXEC);
  if (file < 0) return;
  void* const memory =
      mmap(nullptr, sizeof(netns::RoomPage), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) return;
  page = static_cast<netns::RoomPage*>(memory);
  page->count_load();
}

netns::RoomPage* room() { return page; }

int take_places(int socket, std::uint32_t fragments, int flags, std::uint32_t& places) {
  places = page->places_for(fragments);
  if (page->reserve(places)) return 0;
  if (!is_blocking(socket, flags)) return EAGAIN;
  Places taken(fragments);
  const int error = wait_for_places(taken, send_timeout(socket));
  places = error == 0 ? taken.release() : 0;
  return error;
}

void return_places(std::uint32_t places, bool is_sent) {
  if (is_sent) return page->finish(places);
  page->give_back(places);
  page->change().fetch_add(1);
  wake_for_room();
}

}  // namespace programs::preload
