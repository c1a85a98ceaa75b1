/* asan_own_options: hello, with default options for the address sanitizer. */
#include <stdio.h>

const char* __asan_default_options(void);
const char* __asan_default_options(void) {
  return "detect_leaks=0";
}

int main(void) {
  puts("hello");
  return 7;
}
