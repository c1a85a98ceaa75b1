// Live picture: the writer alternates between two slots, so that a reader has a whole period for its copy.
#include "tilepress/live_picture.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "run/sequenced_words.h"
#include "run/shared_file.h"
#include "tilepress/block.h"
#include "tilepress/plane.h"

namespace tilepress {
namespace {

constexpr uint64_t kMagic = 0x5443'4950'5054;  // "TPPICT\0\0", little-endian
constexpr size_t kHeadWords = sizeof(LivePictureHead) / sizeof(uint64_t);
static_assert(sizeof(LivePictureHead) % sizeof(uint64_t) == 0);
static_assert(sizeof(LivePictureFile) <= kLiveSlotsOffset);

/// The parts of a slot, in 64-bit words. Rows hold whole blocks, so that every part starts on a word.
struct SlotLayout {
  size_t pixel_words, plane_words, words;
  explicit SlotLayout(const LivePictureHead& head)
      : pixel_words(head.blocks_x * kBlockSide / 2 * head.height),
        plane_words((head.blocks_x * head.blocks_y + 3) / 4),
        words(1 + kHeadWords + pixel_words + plane_words * head.scheme_count) {}
};

/// A slot in the file. The sequence comes first.
struct Slot {
  uint64_t* words;
  Slot(LivePictureFile* file, uint64_t number)
      : words(reinterpret_cast<uint64_t*>(reinterpret_cast<std::byte*>(file) + kLiveSlotsOffset +
                                          number % 2 * file->slot_bytes)) {}
  std::atomic<uint64_t>& sequence() const { return *reinterpret_cast<std::atomic<uint64_t>*>(words); }
  uint64_t* head() const { return words + 1; }
  uint64_t* body() const { return head() + kHeadWords; }
};

bool plausible(const LivePictureHead& head) {
  const auto blocks = [](uint64_t side) { return (side + kBlockSide - 1) / kBlockSide; };
  return head.width >= 1 && head.width <= kMaxSurfaceSide && head.height >= 1 &&
         head.height <= kMaxSurfaceSide && head.blocks_x == blocks(head.width) &&
         head.blocks_y == blocks(head.height) && head.scheme_count <= head.state.scheme_count &&
         head.state.scheme_count <= kLiveSchemes && head.format < std::size(kFormatTraits) &&
         head.raw_bits > 0 && head.burst_bits > 0;
}

}  // namespace

LivePictureWriter::~LivePictureWriter() {
  if (file_ != nullptr) munmap(file_, bytes_);
}

int LivePictureWriter::make_file(const std::string& run_path, size_t slot_bytes) {
  close();
  path_ = run_path + "/" + kLivePictureFile;
  bytes_ = kLiveSlotsOffset + 2 * slot_bytes;
  file_ = static_cast<LivePictureFile*>(create_shared_file(path_, bytes_));
  if (file_ == nullptr) return errno;
  file_->version = kLivePictureVersion;
  file_->head_bytes = sizeof(LivePictureHead);
  file_->slot_bytes = slot_bytes;
  store_words(&file_->magic, &kMagic, 1);
  return 0;
}

int LivePictureWriter::write(const std::string& run_path, const LiveState& state, const SurfaceView& view,
                             const BlockBits& bits, uint32_t burst_bits) {
  LivePictureHead head{};
  head.state = state;
  head.width = view.width;
  head.height = view.height;
  head.format = static_cast<uint64_t>(view.format);
  head.blocks_x = bits.blocks_x;
  head.blocks_y = bits.blocks_y;
  head.raw_bits = bits.raw_bits;
  head.burst_bits = burst_bits;
  head.scheme_count = std::min<uint64_t>(bits.schemes.size(), state.scheme_count);
  const SlotLayout layout(head);
  const size_t slot_bytes = layout.words * sizeof(uint64_t);
  if (file_ == nullptr || file_->slot_bytes < slot_bytes)
    if (const int error = make_file(run_path, slot_bytes); error != 0) return error;

  PixelPlane plane;
  plane.assign(view);
  std::vector<uint64_t> rows(layout.pixel_words), counts(layout.plane_words);
  std::memcpy(rows.data(), plane.row(0), rows.size() * sizeof(uint64_t));
  head.number = ++number_;
  uint64_t head_words[kHeadWords];
  std::memcpy(head_words, &head, sizeof head);
  const Slot slot(file_, number_);
  {
    const SequencedWrite write(slot.sequence());
    store_words(slot.head(), head_words, kHeadWords);
    store_words(slot.body(), rows.data(), rows.size());
    for (size_t i = 0; i < head.scheme_count; ++i) {
      if (bits.schemes[i].empty()) std::fill(counts.begin(), counts.end(), ~uint64_t{0});
      std::memcpy(counts.data(), bits.schemes[i].data(), bits.schemes[i].size() * sizeof(uint16_t));
      store_words(slot.body() + layout.pixel_words + i * layout.plane_words, counts.data(), counts.size());
    }
  }
  file_->latest.store(number_, std::memory_order_release);
  return 0;
}

void LivePictureWriter::close() {
  if (file_ == nullptr) return;
  file_->retired.store(1, std::memory_order_release);
  munmap(file_, bytes_);
  file_ = nullptr;
  unlink(path_.c_str());
}

LivePictureReader::~LivePictureReader() {
  unmap();
}

void LivePictureReader::unmap() {
  if (file_ != nullptr) munmap(file_, bytes_);
  file_ = nullptr;
}

bool LivePictureReader::open(const std::string& run_path) {
  if (file_ != nullptr && file_->retired.load(std::memory_order_acquire) == 0) return true;
  unmap();
  file_ = static_cast<LivePictureFile*>(
      map_shared_file(run_path + "/" + kLivePictureFile, kLiveSlotsOffset, false, bytes_));
  if (file_ == nullptr) return false;
  uint64_t magic = 0;
  load_words(&file_->magic, &magic, 1);
  if (magic == kMagic && file_->version == kLivePictureVersion &&
      file_->head_bytes == sizeof(LivePictureHead) && file_->slot_bytes % sizeof(uint64_t) == 0 &&
      file_->slot_bytes >= sizeof(uint64_t) + sizeof(LivePictureHead) &&
      file_->slot_bytes <= (bytes_ - kLiveSlotsOffset) / 2)
    return true;
  unmap();
  return false;
}

bool LivePictureReader::copy_slot(uint64_t number, LivePicture& out) {
  const Slot slot(file_, number);
  const SequencedRead read(slot.sequence());
  uint64_t head_words[kHeadWords];
  load_words(slot.head(), head_words, kHeadWords);
  if (!read.whole()) return false;
  LivePictureHead head;
  std::memcpy(&head, head_words, sizeof head);
  if (!plausible(head)) return false;
  const SlotLayout layout(head);
  if (layout.words > file_->slot_bytes / sizeof(uint64_t)) return false;
  std::vector<uint64_t> rows(layout.pixel_words), counts(layout.plane_words * head.scheme_count);
  load_words(slot.body(), rows.data(), rows.size());
  load_words(slot.body() + layout.pixel_words, counts.data(), counts.size());
  if (!read.whole()) return false;
  out.head = head;
  out.pixels.resize(rows.size() * 2);
  std::memcpy(out.pixels.data(), rows.data(), rows.size() * sizeof(uint64_t));
  out.bits.resize(head.scheme_count);
  for (size_t i = 0; i < head.scheme_count; ++i) {
    out.bits[i].resize(head.blocks_x * head.blocks_y);
    std::memcpy(out.bits[i].data(), counts.data() + i * layout.plane_words,
                out.bits[i].size() * sizeof(uint16_t));
    if (out.bits[i].front() == kNoBlockBits) out.bits[i].clear();
  }
  return true;
}

bool LivePictureReader::read(const std::string& run_path, LivePicture& out) {
  if (!open(run_path)) return false;
  const uint64_t latest = file_->latest.load(std::memory_order_acquire);
  return latest != 0 && latest != out.head.number && copy_slot(latest, out);
}

}  // namespace tilepress
