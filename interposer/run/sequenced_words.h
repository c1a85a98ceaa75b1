// Sequenced words: a sequence lock over shared memory that another process reads, in terms that a thread
// sanitizer understands (no fences, no plain accesses).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tilepress {

/// Stores `count` words. Release: whoever sees one of them also sees that the sequence was odd by then.
inline void store_words(uint64_t* shared, const uint64_t* words, size_t count) {
  for (size_t i = 0; i < count; ++i)
    std::atomic_ref<uint64_t>(shared[i]).store(words[i], std::memory_order_release);
}

/// Loads `count` words. The memory may be mapped read-only: nothing is written.
inline void load_words(const uint64_t* shared, uint64_t* words, size_t count) {
  for (size_t i = 0; i < count; ++i)
    words[i] = std::atomic_ref<uint64_t>(const_cast<uint64_t&>(shared[i])).load(std::memory_order_acquire);
}

/// Around the stores of the one writer. The sequence is odd in between.
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

/// Around the loads of a reader: what was loaded is of one write if whole() says so afterwards.
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
