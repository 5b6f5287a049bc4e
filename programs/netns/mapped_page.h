#pragma once

#include <sys/mman.h>

#include <new>
#include <utility>

#include "programs/netns/descriptor.h"
#include "programs/netns/room_page.h"

namespace programs::netns {

/// The page of an agent's room, mapped as long as this object exists.
class MappedPage {
 public:
  /// Initialises the page. @pre no program uses it yet. @throws std::runtime_error
  explicit MappedPage(const FileDescriptor& file)
      : memory_(
            mmap(nullptr, sizeof(RoomPage), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0)) {
    if (memory_ == MAP_FAILED) fail("the page of an agent's room");
    page_ = new (memory_) RoomPage;
  }
  ~MappedPage() {
    if (page_ != nullptr) munmap(memory_, sizeof(RoomPage));
  }
  MappedPage(MappedPage&& other) noexcept
      : memory_(other.memory_), page_(std::exchange(other.page_, nullptr)) {}
  MappedPage& operator=(MappedPage&&) = delete;
  MappedPage(const MappedPage&) = delete;
  MappedPage& operator=(const MappedPage&) = delete;

  RoomPage& operator*() const { return *page_; }

 private:
  void* memory_;
  RoomPage* page_ = nullptr;
};

}  // namespace programs::netns
