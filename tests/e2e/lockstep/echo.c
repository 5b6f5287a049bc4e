// Echo of UDP: "echo" answers for ever; "echo ADDRESS COUNT" asks so often, and prints how long each
// answer took, in nanoseconds.
#define _GNU_SOURCE
#include <arpa/inet.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <time.h>

static const struct timespec kBeforeFirst = {0, 100000000}, kBetween = {0, 10000000};

static int64_t now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * 1000000000LL + time.tv_nsec;
}

static int answer(int socket) {
  const struct sockaddr_in any = {.sin_family = AF_INET, .sin_port = htons(5000)};
  if (bind(socket, (const struct sockaddr*)&any, sizeof any) != 0) return 1;
  for (;;) {
    char bytes[2000];
    struct sockaddr_in peer;
    socklen_t size = sizeof peer;
    const ssize_t length = recvfrom(socket, bytes, sizeof bytes, 0, (struct sockaddr*)&peer, &size);
    if (length < 0) return 1;
    sendto(socket, bytes, (size_t)length, 0, (struct sockaddr*)&peer, size);
  }
}

static int ask(int socket, const char* address, int times) {
  struct sockaddr_in peer = {.sin_family = AF_INET, .sin_port = htons(5000)};
  inet_pton(AF_INET, address, &peer.sin_addr);
  nanosleep(&kBeforeFirst, NULL);
  for (int i = 0; i < times; ++i) {
    char bytes[64] = {0};
    const int64_t begin = now();
    sendto(socket, bytes, sizeof bytes, 0, (struct sockaddr*)&peer, sizeof peer);
    if (recv(socket, bytes, sizeof bytes, 0) != sizeof bytes) return 1;
    printf("%lld\n", (long long)(now() - begin));
    nanosleep(&kBetween, NULL);
  }
  return 0;
}

int main(int count, char** arguments) {
  const int made = socket(AF_INET, SOCK_DGRAM, 0);
  return count == 3 ? ask(made, arguments[1], atoi(arguments[2])) : answer(made);
}
