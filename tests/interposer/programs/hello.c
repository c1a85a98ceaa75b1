/* hello: presents nothing and ends with 7. */
#include <stdio.h>

int main(void) {
  puts("hello");
  return 7;
}
