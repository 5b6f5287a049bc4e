// Asynchronous input and output: POSIX.1-2017, <aio.h>. The C library's own would be done by
// threads that the run does not know. Requests for one descriptor are done one after the other, by
// a thread that lives as long as there are some.
#include <aio.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <new>

#include "programs/preload/exported.h"
#include "programs/preload/intercepted.h"
#include "programs/waits/kernel_call.h"
#include "programs/waits/notification.h"
#include "programs/waits/parking.h"
#include "programs/waits/signals.h"
#include "programs/waits/virtual_clock.h"

namespace {

using programs::waits::own_slot;
using programs::waits::park;
using programs::waits::Woken;

/// Requests of one lio_listio(), of which somebody is told when the last is done.
struct ListOfRequests {
  int left;
  sigevent event;
};

struct Request {
  aiocb* control;
  int operation;
  ListOfRequests* group;
  bool is_begun;
  Request* next;
};

constexpr int kSynchronise = LIO_NOP + 1, kSynchroniseData = LIO_NOP + 2;

Request* first = nullptr;  ///< In the order in which they were made.
std::int32_t process_of_first = 0;
bool is_done_somewhere = false;

std::uint64_t done_object() { return programs::waits::object_at(&is_done_somewhere); }

Request* first_of(int descriptor) {
  Request* one = first;
  while (one != nullptr && one->control->aio_fildes != descriptor) one = one->next;
  return one;
}

void take_out(Request* request) {
  Request** place = &first;
  while (*place != request) place = &(*place)->next;
  *place = request->next;
}

void tell(const sigevent& event) {
  if (event.sigev_notify == SIGEV_THREAD) {
    programs::waits::call_in_thread(event.sigev_notify_function, event.sigev_value,
                                    programs::waits::stack_of(event));
  } else if (event.sigev_notify == SIGEV_SIGNAL) {
    siginfo_t info{};
    info.si_code = SI_ASYNCIO;
    info.si_pid = own_slot()->process.load();
    info.si_value = event.sigev_value;
    programs::waits::told(programs::waits::kernel_call(
        SYS_rt_sigqueueinfo,
        {own_slot()->process.load(), event.sigev_signo, reinterpret_cast<long>(&info), 0, 0, 0}));
  }
}

/// Others may look at the request from now on, and use its memory again.
void finish(Request* request, ssize_t result, int error) {
  take_out(request);
  aiocb& control = *request->control;
  const sigevent event = control.aio_sigevent;
  control.__return_value = result;
  control.__error_code = error;
  programs::waits::wake(done_object(), ~0U);
  tell(event);
  if (ListOfRequests* const group = request->group; group != nullptr && --group->left == 0) {
    tell(group->event);
    delete group;
  }
  delete request;
}

ssize_t done(const Request& request) {
  const aiocb& control = *request.control;
  auto* const bytes = const_cast<void*>(control.aio_buf);
  const int file = control.aio_fildes;
  const bool has_places = lseek(file, 0, SEEK_CUR) >= 0;
  switch (request.operation) {
    case LIO_READ:
      return has_places ? pread(file, bytes, control.aio_nbytes, control.aio_offset)
                        : read(file, bytes, control.aio_nbytes);
    case LIO_WRITE:
      return has_places ? pwrite(file, bytes, control.aio_nbytes, control.aio_offset)
                        : write(file, bytes, control.aio_nbytes);
    case kSynchroniseData:
      return fdatasync(file);
    default:
      return fsync(file);
  }
}

void* serve(void* given) {
  Request* request = static_cast<Request*>(given);
  const int descriptor = request->control->aio_fildes;
  // While this one told of an end, another request of the descriptor may have got a server.
  for (; request != nullptr && !request->is_begun; request = first_of(descriptor)) {
    request->is_begun = true;
    const ssize_t result = done(*request);
    finish(request, result, result < 0 ? errno : 0);
  }
  return nullptr;
}

int failed(int error) {
  errno = error;
  return -1;
}

/// Those of the process that this one was copied from are not its own.
void forget_others() {
  const std::int32_t process = own_slot()->process.load();
  if (process != process_of_first) first = nullptr;
  process_of_first = process;
}

int submit(aiocb* control, int operation, ListOfRequests* group) {
  forget_others();
  const bool is_served = first_of(control->aio_fildes) != nullptr;
  auto* const request = new (std::nothrow) Request{control, operation, group, false, nullptr};
  if (request == nullptr) return failed(EAGAIN);
  Request** end = &first;
  while (*end != nullptr) end = &(*end)->next;
  *end = request;
  control->__error_code = EINPROGRESS;
  control->__return_value = -1;
  if (is_served || programs::waits::start_server(serve, request) == 0) return 0;
  take_out(request);
  delete request;
  control->__error_code = EAGAIN;
  return failed(EAGAIN);
}

bool is_in_progress(const aiocb* control) {
  return control != nullptr && control->__error_code == EINPROGRESS;
}

/// @return 0, or EINTR. Of what is not in progress: at once.
int wait_for_all(aiocb* const list[], int count) {
  while (std::any_of(list, list + count, is_in_progress)) {
    if (park(done_object(), programs::waits::kNever) == Woken::kBySignal) return EINTR;
  }
  return 0;
}

bool is_wanted(const aiocb* control) {
  return control != nullptr && control->aio_lio_opcode != LIO_NOP;
}

/// Somebody who is told when all of them are done; null: nobody has to be, or was already.
ListOfRequests* told_of(aiocb* const list[], int count, const sigevent* event) {
  if (event == nullptr) return nullptr;
  const auto wanted = static_cast<int>(std::count_if(list, list + count, is_wanted));
  if (wanted > 0) return new (std::nothrow) ListOfRequests{wanted, *event};
  tell(*event);
  return nullptr;
}

bool submit_all(aiocb* const list[], int count, ListOfRequests* group) {
  bool are_all = true;
  for (int i = 0; i < count; ++i) {
    if (is_wanted(list[i]) && submit(list[i], list[i]->aio_lio_opcode, group) != 0) are_all = false;
  }
  return are_all;
}

}  // namespace

BARAKA_EXPORTED int aio_read64(aiocb64* control) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(aio_read64)(control);
  return submit(reinterpret_cast<aiocb*>(control), LIO_READ, nullptr);
}

BARAKA_EXPORTED int aio_write64(aiocb64* control) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(aio_write64)(control);
  return submit(reinterpret_cast<aiocb*>(control), LIO_WRITE, nullptr);
}

BARAKA_EXPORTED int aio_fsync64(int how, aiocb64* control) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(aio_fsync64)(how, control);
  if (how != O_SYNC && how != O_DSYNC) return failed(EINVAL);
  return submit(reinterpret_cast<aiocb*>(control), how == O_SYNC ? kSynchronise : kSynchroniseData,
                nullptr);
}

BARAKA_EXPORTED int aio_suspend64(const aiocb64* const list[], int count,
                                  const timespec* __restrict timeout) {
  if (own_slot() == nullptr) return BARAKA_NEXT(aio_suspend64)(list, count, timeout);
  const auto* const all = reinterpret_cast<const aiocb* const*>(list);
  const auto is_done = [](const aiocb* one) { return one != nullptr && !is_in_progress(one); };
  const auto deadline = programs::waits::deadline_in(timeout);
  const bool is_one =
      std::any_of(all, all + count, [](const aiocb* one) { return one != nullptr; });
  while (is_one && !std::any_of(all, all + count, is_done)) {
    const Woken woken = park(done_object(), deadline);
    if (woken == Woken::kBySignal) return failed(EINTR);
    if (woken == Woken::kByDeadline && !std::any_of(all, all + count, is_done))
      return failed(EAGAIN);
  }
  return 0;
}

/// Those that have not begun are not done any more.
BARAKA_EXPORTED int aio_cancel64(int descriptor, aiocb64* control) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(aio_cancel64)(descriptor, control);
  if (fcntl(descriptor, F_GETFL) < 0) return -1;
  int answer = AIO_ALLDONE;
  for (Request* one = first; one != nullptr;) {
    Request* const request = one;
    one = one->next;
    const auto* const its = reinterpret_cast<aiocb64*>(request->control);
    if (request->control->aio_fildes != descriptor || (control != nullptr && its != control))
      continue;
    if (request->is_begun || request == first_of(descriptor)) {
      answer = AIO_NOTCANCELED;
      continue;
    }
    finish(request, -1, ECANCELED);
    if (answer == AIO_ALLDONE) answer = AIO_CANCELED;
  }
  return answer;
}

BARAKA_EXPORTED int lio_listio64(int mode, aiocb64* const list[], int count,
                                 sigevent* __restrict event) noexcept {
  if (own_slot() == nullptr) return BARAKA_NEXT(lio_listio64)(mode, list, count, event);
  if (mode != LIO_WAIT && mode != LIO_NOWAIT) return failed(EINVAL);
  auto* const all = reinterpret_cast<aiocb* const*>(list);
  if (mode == LIO_NOWAIT)
    return submit_all(all, count, told_of(all, count, event)) ? 0 : failed(EIO);
  const bool are_submitted = submit_all(all, count, nullptr);
  if (const int error = wait_for_all(all, count); error != 0) return failed(error);
  const auto is_well = [](const aiocb* one) { return !is_wanted(one) || one->__error_code == 0; };
  return are_submitted && std::all_of(all, all + count, is_well) ? 0 : failed(EIO);
}

// What they take is the same where files are as large as they may be.
static_assert(sizeof(aiocb) == sizeof(aiocb64) &&
              offsetof(aiocb, aio_offset) == offsetof(aiocb64, aio_offset));

BARAKA_EXPORTED int aio_read(aiocb* control) noexcept {
  return aio_read64(reinterpret_cast<aiocb64*>(control));
}
BARAKA_EXPORTED int aio_write(aiocb* control) noexcept {
  return aio_write64(reinterpret_cast<aiocb64*>(control));
}
BARAKA_EXPORTED int aio_fsync(int how, aiocb* control) noexcept {
  return aio_fsync64(how, reinterpret_cast<aiocb64*>(control));
}
BARAKA_EXPORTED int aio_suspend(const aiocb* const list[], int count,
                                const timespec* __restrict timeout) {
  return aio_suspend64(reinterpret_cast<const aiocb64* const*>(list), count, timeout);
}
BARAKA_EXPORTED int aio_cancel(int descriptor, aiocb* control) noexcept {
  return aio_cancel64(descriptor, reinterpret_cast<aiocb64*>(control));
}
BARAKA_EXPORTED int lio_listio(int mode, aiocb* const list[], int count,
                               sigevent* __restrict event) noexcept {
  return lio_listio64(mode, reinterpret_cast<aiocb64* const*>(list), count, event);
}
