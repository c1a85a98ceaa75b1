// Sequenced words: a sequence lock over memory that another process reads. It has no fences and no plain
// accesses, so that a thread sanitizer understands it.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tilepress {

/// Stores `count` words. Release: a reader that sees a new word also sees the odd sequence.
inline void store_words(uint64_t* shared, const uint64_t* words, size_t count) {
  for (size_t i = 0; i < count; ++i)
    std::atomic_ref<uint64_t>(shared[i]).store(words[i], std::memory_order_release);
}

/// Loads `count` words. Works on memory that is mapped read-only.
inline void load_words(const uint64_t* shared, uint64_t* words, size_t count) {
  for (size_t i = 0; i < count; ++i)
    words[i] = std::atomic_ref<uint64_t>(const_cast<uint64_t&>(shared[i])).load(std::memory_order_acquire);
}

/// Surrounds the stores of the only writer. The sequence is odd meanwhile.
class SequencedWrite {
 public:
  explicit SequencedWrite(std::atomic<uint64_t>& sequence) : sequence_(sequence) {
    sequence_.store(sequence_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  SequencedWrite(const SequencedWrite&) = delete;
  SequencedWrite& operator=(const SequencedWrite&) = delete;
  ~SequencedWrite() {
    sequence_.store(sequence_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }

 private:
  std::atomic<uint64_t>& sequence_;
};

/// Surrounds the loads of a reader. If whole() is true afterwards, all loaded words are from one write.
class SequencedRead {
 public:
  explicit SequencedRead(const std::atomic<uint64_t>& sequence)
      : sequence_(sequence), before_(sequence.load(std::memory_order_acquire)) {}
  bool whole() const { return before_ % 2 == 0 && sequence_.load(std::memory_order_relaxed) == before_; }

 private:
  const std::atomic<uint64_t>& sequence_;
  const uint64_t before_;
};

}  // namespace tilepress
