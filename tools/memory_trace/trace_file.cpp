// Trace file: zlib's and libzstd's streams.
#include "memory_trace/trace_file.h"

#include <zlib.h>
#include <zstd.h>

#include <array>

namespace tilepress {

/// Compresses a stream of bytes, and writes it to a file.
class TraceFile::Packer {
 public:
  virtual ~Packer() = default;
  /// `last`: nothing follows. Returns false if the library fails.
  virtual bool pack(std::string_view bytes, bool last, OutputFile& out) = 0;
};

namespace {

constexpr size_t kPieceBytes = 1 << 16;

class GzipPacker : public TraceFile::Packer {
 public:
  GzipPacker() {
    constexpr int kGzipWindow = 15 + 16;
    constexpr int kMemoryLevel = 8;
    good_ = deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, kGzipWindow, kMemoryLevel, Z_DEFAULT_STRATEGY) == Z_OK;
  }
  ~GzipPacker() override { deflateEnd(&stream_); }

  bool pack(std::string_view bytes, bool last, OutputFile& out) override {
    if (!good_) return false;
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      stream_.next_out = reinterpret_cast<Bytef*>(piece_.data());
      stream_.avail_out = kPieceBytes;
      if (deflate(&stream_, last ? Z_FINISH : Z_NO_FLUSH) == Z_STREAM_ERROR) return false;
      out.write({piece_.data(), kPieceBytes - stream_.avail_out});
    } while (stream_.avail_out == 0);
    return true;
  }

 private:
  z_stream stream_{};
  bool good_ = false;
  std::array<char, kPieceBytes> piece_;
};

class ZstdPacker : public TraceFile::Packer {
 public:
  ZstdPacker() : context_(ZSTD_createCCtx()) {
    ZSTD_CCtx_setParameter(context_, ZSTD_c_compressionLevel, 1);
    ZSTD_CCtx_setParameter(context_, ZSTD_c_checksumFlag, 1);
  }
  ~ZstdPacker() override { ZSTD_freeCCtx(context_); }

  bool pack(std::string_view bytes, bool last, OutputFile& out) override {
    ZSTD_inBuffer in{bytes.data(), bytes.size(), 0};
    for (;;) {
      ZSTD_outBuffer piece{piece_.data(), kPieceBytes, 0};
      const size_t left = ZSTD_compressStream2(context_, &piece, &in, last ? ZSTD_e_end : ZSTD_e_continue);
      if (ZSTD_isError(left)) return false;
      out.write({piece_.data(), piece.pos});
      if (last ? left == 0 : in.pos == in.size) return true;
    }
  }

 private:
  ZSTD_CCtx* context_;
  std::array<char, kPieceBytes> piece_;
};

}  // namespace

TraceFile::TraceFile() = default;
TraceFile::~TraceFile() = default;

Result<void> TraceFile::open(const std::string& path, bool replace) {
  path_ = path;
  if (path.ends_with(".gz")) packer_ = std::make_unique<GzipPacker>();
  if (path.ends_with(".zst")) packer_ = std::make_unique<ZstdPacker>();
  return file_.open(path, replace);
}

void TraceFile::write(std::string_view bytes) {
  if (packer_)
    failed_ |= !packer_->pack(bytes, false, file_);
  else
    file_.write(bytes);
}

Result<void> TraceFile::commit() {
  if (packer_) failed_ |= !packer_->pack({}, true, file_);
  if (failed_) return Error{ErrorKind::kSystem, path_ + ": cannot be compressed: out of memory"};
  return file_.commit();
}

}  // namespace tilepress
