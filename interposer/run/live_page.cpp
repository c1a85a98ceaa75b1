// Live page: a sequence lock over one mapped struct.
#include "tilepress/live_page.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace tilepress {
namespace {

constexpr char kMagic[8] = {'T', 'P', 'L', 'I', 'V', 'E', 0, 0};
constexpr int kReadAttempts = 100;

void copy_name(char (&out)[kLiveNameBytes], const std::string& name) {
  std::memset(out, 0, sizeof out);
  std::memcpy(out, name.data(), std::min(name.size(), sizeof out - 1));
}

}  // namespace

LiveWriter::~LiveWriter() {
  if (page_ != nullptr) munmap(page_, sizeof(LivePage));
}

void LiveWriter::open(const std::string& run_path, const RunInfo& info, const RunOptions& options) {
  path_ = run_path + "/" + kLiveFile;
  const int file = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0) return;
  // posix_fallocate, not ftruncate: on a full disk a hole would end the program with SIGBUS at the first
  // store.
  void* memory = posix_fallocate(file, 0, sizeof(LivePage)) == 0
                     ? mmap(nullptr, sizeof(LivePage), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0)
                     : MAP_FAILED;
  ::close(file);
  if (memory == MAP_FAILED) {
    unlink(path_.c_str());
    return;
  }
  page_ = static_cast<LivePage*>(memory);
  LiveState& state = page_->state;
  copy_name(state.program, info.program);
  state.pid = info.pid;
  state.scheme_count = std::min(options.schemes.size(), kLiveSchemes);
  for (size_t i = 0; i < state.scheme_count; ++i) copy_name(state.schemes[i].name, options.schemes[i].text);
  page_->version = kLiveVersion;
  page_->size = sizeof(LivePage);
  std::atomic_thread_fence(std::memory_order_release);
  std::memcpy(page_->magic, kMagic, sizeof kMagic);
}

void LiveWriter::update(const FrameStatistics& frame, const std::vector<SchemeStatistics>& totals,
                        const RunCounts& counts, uint64_t queued, uint64_t queue_depth) {
  if (page_ == nullptr) return;
  readback_sum_ns_ += frame.readback_ns;
  encode_sum_ns_ += frame.encode_ns;
  page_->sequence.fetch_add(1, std::memory_order_acq_rel);
  std::atomic_thread_fence(std::memory_order_release);
  LiveState& state = page_->state;
  state.seen = counts.seen;
  state.captured = counts.captured;
  state.dropped = counts.dropped;
  state.skipped = counts.skipped;
  state.unsupported = counts.unsupported;
  state.not_captured = counts.not_captured;
  state.queued = queued;
  state.queue_depth = queue_depth;
  state.frame = frame.frame;
  state.surface = frame.surface;
  state.width = frame.width;
  state.height = frame.height;
  state.time_ns = frame.time_ns;
  state.readback_ns = frame.readback_ns;
  state.encode_ns = frame.encode_ns;
  state.readback_sum_ns = readback_sum_ns_;
  state.encode_sum_ns = encode_sum_ns_;
  state.fvc_coverage = frame.metrics.fvc_coverage;
  state.pixel_change = frame.metrics.pixel_change;
  for (size_t i = 0; i < state.scheme_count && i < frame.schemes.size() && i < totals.size(); ++i) {
    LiveScheme& scheme = state.schemes[i];
    scheme.raw_bits = totals[i].raw_bits;
    scheme.moved_bits = totals[i].moved_bits();
    scheme.frame_raw_bits = frame.schemes[i].raw_bits;
    scheme.frame_moved_bits = frame.schemes[i].moved_bits();
  }
  page_->sequence.fetch_add(1, std::memory_order_release);
}

void LiveWriter::close() {
  if (page_ == nullptr) return;
  munmap(page_, sizeof(LivePage));
  page_ = nullptr;
  unlink(path_.c_str());
}

LiveReader::~LiveReader() {
  if (page_ != nullptr) munmap(const_cast<LivePage*>(page_), sizeof(LivePage));
}

bool LiveReader::open(const std::string& run_path, std::string& error) {
  const std::string path = run_path + "/" + kLiveFile;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    error = path + ": " + std::strerror(errno);
    return false;
  }
  struct stat status {};
  const bool whole = fstat(file, &status) == 0 && status.st_size >= static_cast<off_t>(sizeof(LivePage));
  void* memory = whole ? mmap(nullptr, sizeof(LivePage), PROT_READ, MAP_SHARED, file, 0) : MAP_FAILED;
  ::close(file);
  if (memory == MAP_FAILED) {
    error = path + ": not a live page of this version";
    return false;
  }
  page_ = static_cast<const LivePage*>(memory);
  if (std::memcmp(page_->magic, kMagic, sizeof kMagic) == 0 && page_->version == kLiveVersion &&
      page_->size == sizeof(LivePage))
    return true;
  error = path + ": not a live page of this version";
  munmap(memory, sizeof(LivePage));
  page_ = nullptr;
  return false;
}

bool LiveReader::read(LiveState& out) const {
  for (int attempt = 0; page_ != nullptr && attempt < kReadAttempts; ++attempt) {
    const uint64_t before = page_->sequence.load(std::memory_order_acquire);
    if (before % 2 == 0) {
      std::memcpy(&out, &page_->state, sizeof out);
      std::atomic_thread_fence(std::memory_order_acquire);
      if (page_->sequence.load(std::memory_order_relaxed) == before) return out.scheme_count <= kLiveSchemes;
    }
    sched_yield();
  }
  return false;
}

}  // namespace tilepress
