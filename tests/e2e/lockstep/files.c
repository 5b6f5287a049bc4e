// Waits for files, pipes, processes by descriptors, and the resolver.
#include "kinds.h"

#include <aio.h>
#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/aio_abi.h>
#include <netdb.h>
#include <nss.h>
#include <poll.h>
#include <resolv.h>
#include <semaphore.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/fanotify.h>
#include <sys/file.h>
#include <sys/inotify.h>
#include <sys/sendfile.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>
#include <unistd.h>

static const char kFile[] = "/tmp/waits.lock";
static const struct timespec kMoment = {0, 1000};

static void rest(void) { nanosleep(&kLength, NULL); }

// ---- locks
/// A child has the lock for a while; how it gives it back differs.
static pid_t child_with(int (*locks)(int), void (*gives_back)(int)) {
  const pid_t child = fork();
  if (child != 0) {
    nanosleep(&kMoment, NULL);
    return child;
  }
  const int file = open(kFile, O_RDWR | O_CREAT, 0600);
  locks(file);
  rest();
  gives_back(file);
  nanosleep(&(struct timespec){1, 0}, NULL);
  _exit(0);
}
static void lock_after_child(int (*locks)(int), void (*gives_back)(int)) {
  const pid_t child = child_with(locks, gives_back);
  const int file = open(kFile, O_RDWR | O_CREAT, 0600);
  check(locks(file) == 0, "a lock of a file");
  close(file);
  kill(child, SIGKILL);
  waitpid(child, NULL, 0);
}
static int lock_flock(int file) { return flock(file, LOCK_EX); }
static void unlock_flock(int file) { flock(file, LOCK_UN); }
static void close_file(int file) { close(file); }
static void by_dup2(int file) { dup2(STDERR_FILENO, file); }
static void exit_with(int file) {
  (void)file;
  _exit(0);
}
static void by_flock(void) { lock_after_child(lock_flock, unlock_flock); }
static void by_flock_and_close(void) { lock_after_child(lock_flock, close_file); }
static void by_flock_and_dup2(void) { lock_after_child(lock_flock, by_dup2); }
static void by_flock_and_exit(void) { lock_after_child(lock_flock, exit_with); }
static int lock_lockf(int file) { return lockf(file, F_LOCK, 0); }
static void by_lockf(void) { lock_after_child(lock_lockf, close_file); }
static int lock_record(int file) {
  return fcntl(file, F_SETLKW, &(struct flock){.l_type = F_WRLCK, .l_whence = SEEK_SET, .l_len = 10});
}
static void unlock_record(int file) {
  fcntl(file, F_SETLK, &(struct flock){.l_type = F_UNLCK, .l_whence = SEEK_SET, .l_len = 10});
}
static void by_setlkw(void) { lock_after_child(lock_record, unlock_record); }
static void by_setlkw_and_exit(void) { lock_after_child(lock_record, exit_with); }
static int lock_open_file(int file) {
  return fcntl(file, F_OFD_SETLKW, &(struct flock){.l_type = F_WRLCK, .l_whence = SEEK_SET});
}
static void by_ofd_setlkw(void) { lock_after_child(lock_open_file, close_file); }
/// One after the other, and a lock that is given back is taken again at once by the same thread.
static int got[3];
static void* take_in_turn(void* given) {
  const int file = open(kFile, O_RDWR | O_CREAT, 0600);
  for (int i = 0; i < 3; ++i) {
    flock(file, LOCK_EX);
    rest();
    ++got[(intptr_t)given];
    flock(file, LOCK_UN);
  }
  close(file);
  return NULL;
}
static void by_three_locks(void) {
  pthread_t threads[3];
  for (intptr_t i = 0; i < 3; ++i) pthread_create(&threads[i], NULL, take_in_turn, (void*)i);
  for (int i = 0; i < 3; ++i) pthread_join(threads[i], NULL);
  check(got[0] == 3 && got[1] == 3 && got[2] == 3, "locks in turn");
}

// ---- files and processes that become ready
static void* write_file(void* unused) {
  (void)unused;
  rest();
  const int file = open("/tmp/waits.watched", O_WRONLY | O_CREAT, 0600);
  close(file);
  return NULL;
}
static int watch;
static void read_watch(void) {
  char event[512];
  check(read(watch, event, sizeof event) > 0, "inotify");
}
static void poll_watch(void) {
  check(poll(&(struct pollfd){watch, POLLIN, 0}, 1, -1) == 1, "poll of inotify");
}
static void watch_while(void (*wait)(void)) {
  watch = inotify_init1(IN_CLOEXEC);
  inotify_add_watch(watch, "/tmp", IN_CREATE);
  with(write_file, NULL, wait);
  close(watch);
  unlink("/tmp/waits.watched");
}
static void by_inotify(void) { watch_while(read_watch); }
/// Where the kernel has it for ordinary users (Linux 5.13) and such files.
static void by_fanotify(void) {
  const int notify = fanotify_init(FAN_CLASS_NOTIF | FAN_REPORT_FID, O_RDONLY);
  const int file = open("/tmp/waits.fanotified", O_RDWR | O_CREAT | O_TRUNC, 0600);
  if (fanotify_mark(notify, FAN_MARK_ADD, FAN_MODIFY, AT_FDCWD, "/tmp/waits.fanotified") != 0) {
    rest();
    return;
  }
  const pid_t child = fork();
  if (child == 0) {
    rest();
    (void)!write(file, "x", 1);
    _exit(0);
  }
  struct fanotify_event_metadata events[16];
  check(read(notify, events, sizeof events) > 0 && (events->mask & FAN_MODIFY) != 0, "fanotify");
  waitpid(child, NULL, 0);
  close(notify);
  close(file);
}
static void by_poll_of_inotify(void) { watch_while(poll_watch); }
static pid_t sleeping_child(void) {
  const pid_t child = fork();
  if (child != 0) return child;
  rest();
  _exit(0);
}
static void by_pidfd(void) {
  const pid_t child = sleeping_child();
  const int handle = (int)syscall(SYS_pidfd_open, child, 0);
  check(poll(&(struct pollfd){handle, POLLIN, 0}, 1, -1) == 1, "poll of a pidfd");
  close(handle);
  waitpid(child, NULL, 0);
}
static void by_waitid_of_pidfd(void) {
  const pid_t child = sleeping_child();
  const int handle = (int)syscall(SYS_pidfd_open, child, 0);
  siginfo_t info;
  check(waitid(P_PIDFD, (id_t)handle, &info, WEXITED) == 0 && info.si_pid == child, "waitid of a pidfd");
  close(handle);
}

// ---- pipes
static int from[2], to[2];
static char bytes[1 << 18];  // more than a pipe or a socket holds

static void make_pipes(void) {
  (void)!pipe(from);
  (void)!pipe(to);
}
static void close_pipes(void) {
  for (int i = 0; i < 2; ++i) {
    close(from[i]);
    close(to[i]);
  }
}
static void* write_later(void* unused) {
  (void)unused;
  rest();
  (void)!write(from[1], "x", 1);
  return NULL;
}
static void splice_it(void) { check(splice(from[0], NULL, to[1], NULL, 100, 0) == 1, "splice"); }
static void tee_it(void) { check(tee(from[0], to[1], 100, 0) == 1, "tee"); }
static void with_pipes(void* (*other)(void*), void (*wait)(void)) {
  make_pipes();
  with(other, NULL, wait);
  close_pipes();
}
static void by_splice(void) { with_pipes(write_later, splice_it); }
static void by_tee(void) { with_pipes(write_later, tee_it); }
static void fill(int descriptor) {
  fcntl(descriptor, F_SETFL, O_NONBLOCK);
  while (write(descriptor, bytes, 4096) > 0) continue;
  fcntl(descriptor, F_SETFL, 0);
}
static void* read_later(void* unused) {
  (void)unused;
  rest();
  (void)!read(to[0], bytes, sizeof bytes);
  return NULL;
}
static void vmsplice_it(void) {
  fill(to[1]);
  check(vmsplice(to[1], &(struct iovec){bytes, 100}, 1, 0) == 100, "vmsplice");
}
static void by_vmsplice(void) { with_pipes(read_later, vmsplice_it); }
/// The reader takes a pipe's 64 KiB after each wait.
static void* read_slowly(void* unused) {
  (void)unused;
  for (size_t taken = 0; taken < sizeof bytes;) {
    rest();
    const ssize_t some = read(to[0], bytes, sizeof bytes);
    check(some == 65536, "what a full pipe holds");
    if (some <= 0) break;
    taken += (size_t)some;
  }
  return NULL;
}
static void write_much(void) {
  check(write(to[1], bytes, sizeof bytes) == sizeof bytes, "write of more than a pipe holds");
}
static void by_write(void) { with_pipes(read_slowly, write_much); }
static void write_parts(void) {
  struct iovec parts[3] = {{bytes, 1000}, {bytes, sizeof bytes - 3000}, {bytes, 2000}};
  check(writev(to[1], parts, 3) == sizeof bytes, "writev of more than a pipe holds");
}
static void by_writev(void) { with_pipes(read_slowly, write_parts); }
static void send_file_to(int target) {
  const int file = open("/tmp/waits.sent", O_RDWR | O_CREAT | O_TRUNC, 0600);
  (void)!write(file, bytes, sizeof bytes);
  off_t begin = 0;
  check(sendfile(target, file, &begin, sizeof bytes) == sizeof bytes, "sendfile");
  close(file);
}
static void send_file(void) { send_file_to(to[1]); }
static void by_sendfile(void) { with_pipes(read_slowly, send_file); }
/// A stream takes all of it, too, from one call; and gives as much as it is asked for.
static int stream[2];
static void* receive_slowly(void* unused) {
  (void)unused;
  rest();
  check(recv(stream[0], bytes, sizeof bytes, MSG_WAITALL) == sizeof bytes, "recv of all");
  return NULL;
}
static void send_much(void) {
  struct iovec parts[2] = {{bytes, 1000}, {bytes, sizeof bytes - 1000}};
  const struct msghdr message = {.msg_iov = parts, .msg_iovlen = 2};
  check(sendmsg(stream[1], &message, 0) == sizeof bytes, "sendmsg of more than a socket holds");
}
static void* send_slowly(void* unused) {
  (void)unused;
  for (int i = 0; i < 4; ++i) {
    rest();
    check(send(stream[1], bytes, sizeof bytes / 4, 0) == sizeof bytes / 4, "send");
  }
  return NULL;
}
static void receive_much(void) {
  check(recv(stream[0], bytes, sizeof bytes, MSG_WAITALL) == sizeof bytes, "recv of all, a part at a time");
}
static void with_stream(void* (*other)(void*), void (*wait)(void)) {
  socketpair(AF_UNIX, SOCK_STREAM, 0, stream);
  with(other, NULL, wait);
  close(stream[0]);
  close(stream[1]);
}
static void send_file_by_stream(void) { send_file_to(stream[1]); }
static void by_sendfile_to_socket(void) { with_stream(receive_slowly, send_file_by_stream); }
static void by_sendmsg(void) { with_stream(receive_slowly, send_much); }
static void by_recv_of_all(void) { with_stream(send_slowly, receive_much); }
/// With a part of what is asked for, a time-out or a handler, also one with SA_RESTART, ends it.
static pthread_t receiver;
static void* send_a_part(void* unused) {
  (void)unused;
  rest();
  check(send(stream[1], bytes, 1000, 0) == 1000, "send");
  rest();
  pthread_kill(receiver, SIGUSR1);
  return NULL;
}
static void receive_a_part(void) {
  check(recv(stream[0], bytes, sizeof bytes, MSG_WAITALL) == 1000, "recv of all, but a part");
}
static void nothing(int signal) { (void)signal; }
static void by_recv_of_part(void) {
  receiver = pthread_self();
  const struct sigaction action = {.sa_handler = nothing, .sa_flags = SA_RESTART};
  struct sigaction before;
  sigset_t open, closed;
  sigemptyset(&open);
  sigaddset(&open, SIGUSR1);
  sigaction(SIGUSR1, &action, &before);
  pthread_sigmask(SIG_UNBLOCK, &open, &closed);
  with_stream(send_a_part, receive_a_part);
  pthread_sigmask(SIG_SETMASK, &closed, NULL);
  sigaction(SIGUSR1, &before, NULL);
}
static void receive_for_a_while(void) {
  const struct timeval most = {0, 3000};
  setsockopt(stream[0], SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
  check(recv(stream[0], bytes, sizeof bytes, MSG_WAITALL) == 100000, "recv of all, until a time-out");
}
static void* send_one_part(void* unused) {
  (void)unused;
  rest();
  check(send(stream[1], bytes, 100000, 0) == 100000, "send");
  return NULL;
}
static void by_recv_with_time_out(void) { with_stream(send_one_part, receive_for_a_while); }
static void* open_later(void* unused) {
  (void)unused;
  rest();
  close(open("/tmp/waits.fifo", O_WRONLY));
  return NULL;
}
static void open_pipe(void) {
  const int file = open("/tmp/waits.fifo", O_RDONLY);
  check(file >= 0, "a named pipe");
  close(file);
}
static void by_named_pipe(void) {
  unlink("/tmp/waits.fifo");
  mkfifo("/tmp/waits.fifo", 0600);
  with(open_later, NULL, open_pipe);
}

// ---- asynchronous input and output
static struct aiocb control;
static void prepare_aio(void) {
  static char byte;
  memset(&control, 0, sizeof control);
  control.aio_fildes = from[0];
  control.aio_buf = &byte;
  control.aio_nbytes = 1;
  control.aio_lio_opcode = LIO_READ;
}
static void suspend_aio(void) {
  prepare_aio();
  const struct aiocb* const list[] = {&control};
  check(aio_read(&control) == 0 && aio_suspend(list, 1, NULL) == 0, "aio_suspend");
  check(aio_error(&control) == 0 && aio_return(&control) == 1, "aio_read");
}
static void by_aio_suspend(void) { with_pipes(write_later, suspend_aio); }
static void list_aio(void) {
  prepare_aio();
  struct aiocb* const list[] = {&control};
  check(lio_listio(LIO_WAIT, list, 1, NULL) == 0, "lio_listio");
}
static void by_lio_listio(void) { with_pipes(write_later, list_aio); }

static sigset_t signal_of_aio(void) {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGRTMIN + 9);
  return set;
}
static void hear_of_aio(void) {
  const sigset_t set = signal_of_aio();
  prepare_aio();
  control.aio_sigevent = (struct sigevent){.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGRTMIN + 9,
                                           .sigev_value = {.sival_int = 12}};
  check(aio_read(&control) == 0, "aio_read with a signal");
  struct aiocb second = control;
  check(aio_read(&second) == 0 && aio_cancel(from[0], &second) == AIO_CANCELED, "aio_cancel of what waits");
  check(aio_error(&second) == ECANCELED && aio_cancel(from[0], &control) == AIO_NOTCANCELED, "aio_cancel of what is under way");
  siginfo_t info;
  for (int i = 0; i < 2; ++i)
    check(sigwaitinfo(&set, &info) > 0 && info.si_code == SI_ASYNCIO && info.si_value.sival_int == 12, "its signal");
  check(aio_return(&control) == 1, "what was read");
}
/// All threads block the signal, else it would end the process.
static void by_signal_of_aio(void) {
  const sigset_t set = signal_of_aio();
  pthread_sigmask(SIG_BLOCK, &set, NULL);
  with_pipes(write_later, hear_of_aio);
}
static sem_t all_done;
static void post_all_done(union sigval value) {
  (void)value;
  sem_post(&all_done);
}
/// Two requests for one file, one after the other, and one for a pipe.
static void hear_of_list(void) {
  prepare_aio();
  sem_init(&all_done, 0, 0);
  const int file = open("/tmp/waits.aio", O_RDWR | O_CREAT | O_TRUNC, 0600);
  struct aiocb first = {.aio_fildes = file, .aio_buf = (void*)"abcd", .aio_nbytes = 4, .aio_lio_opcode = LIO_WRITE};
  struct aiocb second = {.aio_fildes = file, .aio_buf = (void*)"x", .aio_nbytes = 1, .aio_offset = 1, .aio_lio_opcode = LIO_WRITE};
  first.aio_sigevent.sigev_notify = second.aio_sigevent.sigev_notify = control.aio_sigevent.sigev_notify = SIGEV_NONE;
  struct aiocb* const list[] = {&first, &second, NULL, &control};
  struct sigevent event = {.sigev_notify = SIGEV_THREAD};
  event.sigev_notify_function = post_all_done;
  check(lio_listio(LIO_NOWAIT, list, 4, &event) == 0, "lio_listio that does not wait");
  sem_wait(&all_done);
  char text[5] = "";
  check(pread(file, text, 4, 0) == 4 && strcmp(text, "axcd") == 0, "what was written");
  check(aio_return(&control) == 1, "what was read");
  close(file);
}
static void by_thread_of_list(void) { with_pipes(write_later, hear_of_list); }

// ---- the kernel's own
static aio_context_t context;
static void poll_by_kernel(void) {
  struct iocb wanted = {.aio_lio_opcode = IOCB_CMD_POLL, .aio_fildes = (uint32_t)from[0], .aio_buf = POLLIN, .aio_data = 7};
  struct iocb* all[1] = {&wanted};
  struct io_event event;
  check(syscall(SYS_io_submit, context, 1, all) == 1, "io_submit");
  check(syscall(SYS_io_getevents, context, 1, 1, &event, &(struct timespec){0, 1000}) == 0, "io_getevents until");
  check(syscall(SYS_io_getevents, context, 1, 1, &event, NULL) == 1 && event.data == 7, "io_getevents");
}
static void by_io_getevents(void) {
  check(syscall(SYS_io_setup, 8, &context) == 0, "io_setup");
  with_pipes(write_later, poll_by_kernel);
  syscall(SYS_io_destroy, context);
}

// ---- the resolver
/// Nobody answers at this port.
static void by_getaddrinfo(void) {
  const int silent = socket(AF_INET, SOCK_DGRAM, 0);
  struct sockaddr_in address = {.sin_family = AF_INET, .sin_port = htons(5353)};
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  check(bind(silent, (struct sockaddr*)&address, sizeof address) == 0, "a port for names");
  res_init();
  _res.nscount = 1;
  _res.nsaddr_list[0] = address;
  _res.retrans = 1;
  _res.retry = 1;
  __nss_configure_lookup("hosts", "dns");
  struct addrinfo* found = NULL;
  const struct addrinfo hints = {.ai_family = AF_INET, .ai_socktype = SOCK_DGRAM};
  check(getaddrinfo("nobody.example.", NULL, &hints, &found) == EAI_AGAIN, "getaddrinfo");
  close(silent);
}

const struct Kind file_kinds[] = {
    {"flock", by_flock, 1234567},
    {"flock and close", by_flock_and_close, 1234567},
    {"flock and dup2", by_flock_and_dup2, 1234567},
    {"flock and exit", by_flock_and_exit, 1234567},
    {"lockf", by_lockf, 1234567},
    {"F_SETLKW", by_setlkw, 1234567},
    {"F_SETLKW and exit", by_setlkw_and_exit, 1234567},
    {"F_OFD_SETLKW", by_ofd_setlkw, 1234567},
    {"flock in turn", by_three_locks, 9 * 1234567},
    {"inotify", by_inotify, 1234567},
    {"fanotify", by_fanotify, 1234567},
    {"inotify, poll", by_poll_of_inotify, 1234567},
    {"pidfd, poll", by_pidfd, 1234567},
    {"pidfd, waitid", by_waitid_of_pidfd, 1234567},
    {"splice", by_splice, 1234567},
    {"tee", by_tee, 1234567},
    {"vmsplice", by_vmsplice, 1234567},
    {"write of much", by_write, 4 * 1234567},
    {"writev of much", by_writev, 4 * 1234567},
    {"sendfile", by_sendfile, 4 * 1234567},
    {"sendfile to a socket", by_sendfile_to_socket, 1234567},
    {"sendmsg of much", by_sendmsg, 1234567},
    {"recv, MSG_WAITALL", by_recv_of_all, 4 * 1234567},
    {"recv, MSG_WAITALL, signal", by_recv_of_part, 2 * 1234567},
    {"recv, MSG_WAITALL, SO_RCVTIMEO", by_recv_with_time_out, 3000000},
    {"open of a named pipe", by_named_pipe, 1234567},
    {"aio_suspend", by_aio_suspend, 1234567},
    {"lio_listio", by_lio_listio, 1234567},
    {"aio, signal", by_signal_of_aio, 1234567},
    {"lio_listio, LIO_NOWAIT", by_thread_of_list, 1234567},
    {"io_getevents", by_io_getevents, 1234567},
    {"getaddrinfo", by_getaddrinfo, 1000000000},
};
const size_t file_kinds_count = sizeof file_kinds / sizeof *file_kinds;
