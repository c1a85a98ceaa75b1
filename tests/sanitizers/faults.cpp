// Programs with both sanitizers end at each of these faults. Usage: sanitized_faults overflow|global|heap
#include <cstdlib>
#include <cstring>

namespace {

int table[4] = {1, 2, 3, 4};

// The compiler must not know where the pointer points.
int read_at(const int* begin, int index) {
  asm volatile("" : "+r"(begin));
  return begin[index];
}

}  // namespace

int main(int count, char** arguments) {
  const char* fault = count == 2 ? arguments[1] : "";
  if (std::strcmp(fault, "overflow") == 0) {
    volatile int most = 0x7fffffff;
    return most + count;
  }
  if (std::strcmp(fault, "global") == 0) {
    return read_at(table, count + 2);
  }
  if (std::strcmp(fault, "heap") == 0) {
    int* block = static_cast<int*>(std::calloc(4, sizeof(int)));
    const int value = read_at(block, count + 2);
    std::free(block);
    return value;
  }
  return 0;
}
