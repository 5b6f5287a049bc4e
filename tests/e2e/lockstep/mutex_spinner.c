/* Takes and returns a mutex until another thread, which sleeps for 1 ms first, has taken it, too.
 * Prints how long that took [ns]. Without a turn of the other thread it never ends. */
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <time.h>

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static bool is_done;

static void* other(void* unused) {
  nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
  pthread_mutex_lock(&mutex);
  is_done = true;
  pthread_mutex_unlock(&mutex);
  return unused;
}

static long long now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000000000LL + time.tv_nsec;
}

int main(void) {
  const long long begin = now();
  pthread_t thread;
  if (pthread_create(&thread, NULL, other, NULL) != 0) return 1;
  for (bool is_over = false; !is_over;) {
    pthread_mutex_lock(&mutex);
    is_over = is_done;
    pthread_mutex_unlock(&mutex);
  }
  pthread_join(thread, NULL);
  printf("%lld\n", now() - begin);
  return 0;
}
