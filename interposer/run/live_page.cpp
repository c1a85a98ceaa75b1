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

#include "run/descriptors.h"
#include "run/sequenced_words.h"
#include "system_calls.h"
#include "tilepress/file_error.h"

namespace tilepress {
namespace {

constexpr uint64_t kMagic = 0x4556'494C'5054;  // "TPLIVE\0\0", little-endian
constexpr int kReadAttempts = 100;
constexpr uint64_t kRequestHoldsNs = 2'000'000'000, kPicturePeriodNs = 100'000'000;
constexpr size_t kStateWords = sizeof(LiveState) / sizeof(uint64_t);

void copy_name(char (&out)[kLiveNameBytes], const std::string& name) {
  std::memset(out, 0, sizeof out);
  std::memcpy(out, name.data(), std::min(name.size(), sizeof out - 1));
}

uint64_t* words_of(LiveState& state) {
  return reinterpret_cast<uint64_t*>(&state);
}

void publish(LivePage& page, LiveState& state) {
  const SequencedWrite write(page.sequence);
  store_words(words_of(page.state), words_of(state), kStateWords);
}

/// Makes a new file with zeros and maps it. Returns null on failure, and leaves no file.
LivePage* create_page(const std::string& path) {
  const int file = open_above_streams(path, O_RDWR | O_CREAT | O_EXCL, 0644);
  if (file < 0) return nullptr;
  // Not ftruncate: on a full disk, the first store into a hole would end the program with SIGBUS.
  void* memory = MAP_FAILED;
  if (posix_fallocate(file, 0, sizeof(LivePage)) == 0)
    memory = mmap(nullptr, sizeof(LivePage), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory != MAP_FAILED) return static_cast<LivePage*>(memory);
  unlink(path.c_str());
  return nullptr;
}

}  // namespace

LiveWriter::~LiveWriter() {
  if (page_ != nullptr) munmap(page_, sizeof(LivePage));
}

void LiveWriter::open(const std::string& run_path, const RunInfo& info, const RunOptions& options) {
  path_ = run_path + "/" + kLiveFile;
  page_ = create_page(path_);
  if (page_ == nullptr) return;
  copy_name(state_.program, info.program);
  state_.pid = info.pid;
  state_.scheme_count = std::min(options.schemes.size(), kLiveSchemes);
  for (size_t i = 0; i < state_.scheme_count; ++i) copy_name(state_.schemes[i].name, options.schemes[i].text);
  publish(*page_, state_);
  page_->version = kLiveVersion;
  page_->size = sizeof(LivePage);
  store_words(&page_->magic, &kMagic, 1);
}

void LiveWriter::update(const FrameStatistics& frame, const std::vector<SchemeStatistics>& totals,
                        const RunCounts& counts, uint64_t queued, uint64_t queue_depth) {
  if (page_ == nullptr) return;
  LiveState& state = state_;
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
  state.readback_sum_ns += frame.readback_ns;
  state.encode_sum_ns += frame.encode_ns;
  state.fvc_coverage = frame.metrics.fvc_coverage;
  state.pixel_change = frame.metrics.pixel_change;
  for (size_t i = 0; i < state.scheme_count && i < frame.schemes.size() && i < totals.size(); ++i) {
    LiveScheme& scheme = state.schemes[i];
    scheme.raw_bits = totals[i].raw_bits;
    scheme.moved_bits = totals[i].moved_bits();
    scheme.extra_bits = totals[i].extra_bits;
    scheme.frame_raw_bits = frame.schemes[i].raw_bits;
    scheme.frame_moved_bits = frame.schemes[i].moved_bits();
    scheme.frame_extra_bits = frame.schemes[i].extra_bits;
  }
  publish(*page_, state);
}

bool LiveWriter::picture_wanted() {
  if (page_ == nullptr) return false;
  const uint64_t requests = page_->picture_requests.load(std::memory_order_relaxed);
  if (requests == 0) return false;  // no watcher ever asked
  const uint64_t now = clock_ns(CLOCK_MONOTONIC);
  if (requests != requests_seen_) {
    requests_seen_ = requests;
    request_seen_ns_ = now;
  }
  if (now - request_seen_ns_ > kRequestHoldsNs || now - picture_ns_ < kPicturePeriodNs) return false;
  picture_ns_ = now;
  return true;
}

void LiveWriter::set_picture_error(int error) {
  if (page_ != nullptr) page_->picture_error.store(static_cast<uint64_t>(error), std::memory_order_relaxed);
}

void LiveWriter::close() {
  if (page_ == nullptr) return;
  page_ = nullptr;  // stays mapped: a thread of the program may be about to count a frame there
  unlink(path_.c_str());
}

LiveReader::~LiveReader() {
  if (page_ != nullptr) munmap(page_, sizeof(LivePage));
}

Result<void> LiveReader::open(const std::string& run_path, bool asks_for_pictures) {
  const std::string path = run_path + "/" + kLiveFile;
  const Error other_version{ErrorKind::kFile, path + ": not a live page of this version"};
  const int file = ::open(path.c_str(), (asks_for_pictures ? O_RDWR : O_RDONLY) | O_CLOEXEC);
  if (file < 0) return file_error(path);
  struct stat status {};
  const bool whole = fstat(file, &status) == 0 && status.st_size >= static_cast<off_t>(sizeof(LivePage));
  const int access = asks_for_pictures ? PROT_READ | PROT_WRITE : PROT_READ;
  void* memory = whole ? mmap(nullptr, sizeof(LivePage), access, MAP_SHARED, file, 0) : MAP_FAILED;
  const Error unmapped = whole ? file_error(path) : other_version;
  close(file);
  if (memory == MAP_FAILED) return unmapped;
  page_ = static_cast<LivePage*>(memory);
  uint64_t magic = 0;
  load_words(&page_->magic, &magic, 1);
  if (magic == kMagic && page_->version == kLiveVersion && page_->size == sizeof(LivePage)) return {};
  munmap(page_, sizeof(LivePage));
  page_ = nullptr;
  return other_version;
}

bool LiveReader::read(LiveState& out) const {
  for (int attempt = 0; page_ != nullptr && attempt < kReadAttempts; ++attempt) {
    const SequencedRead read(page_->sequence);
    load_words(words_of(page_->state), words_of(out), kStateWords);
    if (read.whole()) return out.scheme_count <= kLiveSchemes;
    sched_yield();
  }
  return false;
}

RunCounts LiveReader::presented() const {
  return page_ == nullptr ? RunCounts{} : page_->presented.now();
}

RunCounts LiveReader::targets() const {
  return page_ == nullptr ? RunCounts{} : page_->targets.now();
}

void LiveReader::ask_for_pictures() {
  page_->picture_requests.fetch_add(1, std::memory_order_relaxed);
}

int LiveReader::picture_error() const {
  return page_ == nullptr ? 0 : static_cast<int>(page_->picture_error.load(std::memory_order_relaxed));
}

}  // namespace tilepress
