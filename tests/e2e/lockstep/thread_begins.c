/* What a new thread does before it is its turn: nothing that takes a lock of the C library. The allocator says who gives memory
 * back while the thread that made the other one still runs. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>

extern void __libc_free(void* memory);

static atomic_int is_only_maker_to_run, too_early;
static pthread_t maker;

void free(void* memory) {
  if (is_only_maker_to_run && !pthread_equal(pthread_self(), maker)) too_early = 1;
  __libc_free(memory);
}

static void* go(void* argument) { return argument; }

int main(void) {
  pthread_t thread;
  maker = pthread_self();
  is_only_maker_to_run = 1;
  if (pthread_create(&thread, NULL, go, NULL) != 0) return 1;
  /* Longer than the kernel lets one thread run while another one could. */
  for (volatile long i = 0; i < 300000000; ++i) continue;
  is_only_maker_to_run = 0;
  pthread_join(thread, NULL);
  puts(too_early ? "too early" : "in turn");
  return 0;
}
