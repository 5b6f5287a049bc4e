#pragma once

#include <sys/mman.h>

#include <new>
#include <utility>

#include "programs/netns/descriptor.h"
#include "programs/netns/room_page.h"
#include "programs/netns/wait_page.h"

namespace programs::netns {

/// The file of an agent's RoomPage and WaitPage, mapped as long as this object exists.
class MappedPage {
 public:
  /// Initialises the page. @pre no program uses it yet. @throws std::runtime_error
  explicit MappedPage(const FileDescriptor& file)
      : memory_(mmap(nullptr, kRoomFileSize, PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0)) {
    if (memory_ == MAP_FAILED) fail("the page of an agent's room");
    page_ = new (memory_) RoomPage;
    waits_ = new (static_cast<char*>(memory_) + kWaitPageOffset) WaitPage;
  }
  ~MappedPage() {
    if (page_ != nullptr) munmap(memory_, kRoomFileSize);
  }
  MappedPage(MappedPage&& other) noexcept
      : memory_(other.memory_), page_(std::exchange(other.page_, nullptr)), waits_(other.waits_) {}
  MappedPage& operator=(MappedPage&&) = delete;
  MappedPage(const MappedPage&) = delete;
  MappedPage& operator=(const MappedPage&) = delete;

  RoomPage& operator*() const { return *page_; }
  WaitPage& waits() const { return *waits_; }

 private:
  void* memory_;
  RoomPage* page_ = nullptr;
  WaitPage* waits_ = nullptr;
};

}  // namespace programs::netns
