#include "programs/waits/notification.h"

#include <pthread.h>

#include <cstdlib>
#include <new>

namespace programs::waits {
namespace {

struct Call {
  void (*function)(sigval);
  sigval value;
};

/// Signals are as in the thread that started this one: it may be a server.
void* call(void* given) {
  const Call one = *static_cast<Call*>(given);
  std::free(given);
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_UNBLOCK, &all, nullptr);
  one.function(one.value);
  return nullptr;
}

}  // namespace

int start_detached(void* (*function)(void*), void* argument, std::size_t stack) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  if (stack != 0) pthread_attr_setstacksize(&attributes, stack);
  pthread_t thread{};
  const int error = pthread_create(&thread, &attributes, function, argument);
  pthread_attr_destroy(&attributes);
  return error;
}

int start_server(void* (*function)(void*), void* argument) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  const int error = start_detached(function, argument, 0);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return error;
}

void call_in_thread(void (*function)(sigval), sigval value, std::size_t stack) {
  void* const memory = std::malloc(sizeof(Call));
  if (memory == nullptr) return;
  if (start_detached(call, new (memory) Call{function, value}, stack) != 0) std::free(memory);
}

std::size_t stack_of(const sigevent& event) {
  std::size_t stack = 0;
  if (event.sigev_notify_attributes != nullptr)
    pthread_attr_getstacksize(event.sigev_notify_attributes, &stack);
  return stack;
}

}  // namespace programs::waits
