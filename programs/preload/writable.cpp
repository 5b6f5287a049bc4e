#include "programs/preload/writable.h"

#include "programs/preload/datagram.h"

namespace programs::preload {
namespace {

constexpr short kWritable = POLLOUT | POLLWRNORM;

}  // namespace

bool wants_room(const pollfd* descriptors, nfds_t count) {
  if (room() == nullptr) return false;
  return std::any_of(descriptors, descriptors + count, [](const pollfd& one) {
    return one.fd >= 0 && (one.events & kWritable) != 0 && is_held_back(one.fd);
  });
}

bool wants_room(int count, const fd_set* writable) {
  // Programs with more descriptors use sets of their own size.
  if (room() == nullptr || writable == nullptr || count > FD_SETSIZE) return false;
  for (int i = 0; i < count; ++i) {
    if (FD_ISSET(i, writable) && is_held_back(i)) return true;
  }
  return false;
}

int ready_without_room(pollfd* descriptors, nfds_t count) {
  int ready = 0;
  for (pollfd* one = descriptors; one != descriptors + count; ++one) {
    if ((one->revents & kWritable) != 0 && is_held_back(one->fd)) {
      one->revents = static_cast<short>(one->revents & ~kWritable);
    }
    if (one->revents != 0) ++ready;
  }
  return ready;
}

void clear_without_room(int count, fd_set& writable) {
  for (int i = 0; i < count; ++i) {
    if (FD_ISSET(i, &writable) && is_held_back(i)) FD_CLR(i, &writable);
  }
}

int members(int count, std::initializer_list<const fd_set*> sets) {
  int sum = 0;
  for (const fd_set* set : sets) {
    for (int i = 0; set != nullptr && i < count; ++i) {
      if (FD_ISSET(i, set)) ++sum;
    }
  }
  return sum;
}

}  // namespace programs::preload
