// Row sink: standard output is flushed after each frame.
#include "frames/row_sink.h"

#include <unistd.h>

#include <cstdio>

#include "streams/standard_streams.h"
#include "tilepress/statistics_rows.h"

namespace tilepress {
namespace {

Result<void> print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  return flush_standard_output();
}

}  // namespace

Result<void> RowSink::open(const RunOptions& options, const RunInfo& info, bool force) {
  for (const SchemeSpec& spec : options.schemes) scheme_names_.push_back(spec.text);
  if (options.output == "-") return print(schemes_csv_header());
  if (force)
    for (const char* name : {"/frames.csv", "/schemes.csv", "/run.json"})
      unlink((options.output + name).c_str());
  const auto created = writer_.create(options.output, info, options);
  if (!created && created.error().kind == ErrorKind::kExists)
    return Error{ErrorKind::kExists, created.error().text + " (--force replaces it)"};
  return created;
}

Result<void> RowSink::append(const FrameStatistics& frame) {
  if (writer_.is_open()) return writer_.append(frame);
  text_.clear();
  append_schemes_rows(frame, scheme_names_, text_);
  return print(text_);
}

Result<void> RowSink::finish(const RunCounts& counts, const std::string& state, const std::string& reason) {
  if (!writer_.is_open()) return {};
  writer_.set_counts(counts);
  return writer_.finish(state, reason);
}

}  // namespace tilepress
