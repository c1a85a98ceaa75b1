// Frame packer: follows frames.csv as it grows.
#include "study/cache/frame_packer.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "study/cache/file_bytes.h"
#include "tilepress/csv_rows.h"
#include "tilepress/file_error.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

CachedFrame cached_frame(const FrameStatistics& row) {
  return {.frame = row.frame,
          .surface = row.surface,
          .width = row.width,
          .height = row.height,
          .format = row.format,
          .warmup = row.warmup,
          .time_ns = row.time_ns,
          .readback_ns = row.readback_ns};
}

}  // namespace

FramePacker::~FramePacker() {
  if (rows_ >= 0) close(rows_);
}

/// Reads the rows that are new and whole.
Result<void> FramePacker::read_rows(const std::string& run_path) {
  if (rows_ >= 0 && run_path != run_path_ && packed_ == 0 && waiting_.empty()) {
    close(rows_);
    rows_ = -1;
    header_.clear();
    tail_.clear();
  }
  run_path_ = run_path;
  if (rows_ < 0) rows_ = open((run_path + "/frames.csv").c_str(), O_RDONLY | O_CLOEXEC);
  if (rows_ < 0) return {};
  char buffer[1 << 14];
  for (ssize_t got = 0; (got = ::read(rows_, buffer, sizeof buffer)) > 0;)
    tail_.append(buffer, static_cast<size_t>(got));
  if (header_.empty()) {
    const size_t end = tail_.find('\n');
    if (end == std::string::npos) return {};
    header_ = tail_.substr(0, end + 1);
    tail_.erase(0, end + 1);
  }
  const std::string text = header_ + tail_;
  CsvRecords records(text);
  const CsvRowReader<FrameStatistics> rows(records, frame_columns());
  FrameStatistics row;
  size_t used = header_.size();
  for (; records.next(); used = records.offset()) {
    if (const auto read = rows.read(row); !read) return about(run_path + "/frames.csv", read.error());
    waiting_.push_back(cached_frame(row));
  }
  tail_.erase(0, used - header_.size());
  return {};
}

/// Returns false if the dump is not there, because the run is just being moved.
Result<bool> FramePacker::pack_frame(const std::string& run_path, const CachedFrame& frame, bool last) {
  const std::string path = fmt::format("{}/frames/{}-{:06}.rgba", run_path, frame.surface, frame.frame);
  const int fd = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0 && errno == ENOENT && !last) return false;
  if (fd < 0) return file_error(path);
  struct stat status {};
  const bool whole = fstat(fd, &status) == 0 && static_cast<uint64_t>(status.st_size) == frame.pixel_bytes();
  pixels_.resize(whole ? frame.pixel_bytes() : 0);
  const bool read = whole && read_at(fd, 0, pixels_);
  const Error error = whole ? file_error(path)
                            : Error{ErrorKind::kFile, path + ": not " + std::to_string(frame.width) + "x" +
                                                          std::to_string(frame.height) + " pixels"};
  close(fd);
  if (!read) return error;
  if (const auto added = writer_.add(frame, pixels_); !added) return added.error();
  unlink(path.c_str());
  ++packed_;
  return true;
}

Result<void> FramePacker::pack(const std::string& run_path, bool last) {
  if (const auto read = read_rows(run_path); !read) return read;
  size_t done = 0;
  for (; done < waiting_.size(); ++done) {
    const auto packed = pack_frame(run_path, waiting_[done], last);
    if (!packed) return packed.error();
    if (!*packed) break;
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<ptrdiff_t>(done));
  return {};
}

}  // namespace tilepress
