/* A data race, then _exit(0): a thread sanitizer's own _exit makes status 66 of it. */
#include <pthread.h>
#include <unistd.h>

static int shared;

static void* write_it(void* unused) {
  shared = 1;
  return unused;
}

int main(void) {
  pthread_t thread;
  pthread_create(&thread, NULL, write_it, NULL);
  shared = 2;
  pthread_join(thread, NULL);
  _exit(0);
}
