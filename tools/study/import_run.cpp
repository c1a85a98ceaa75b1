// Import run: schemes.csv cut into one text per configuration.
#include "import_run.h"

#include <map>

#include <nlohmann/json.hpp>

#include "counted.h"
#include "report/run_batch.h"
#include "study/configuration.h"
#include "study/result_store.h"
#include "study/text_file.h"
#include "tilepress/csv_rows.h"
#include "tilepress/file_digest.h"
#include "tilepress/run_reader.h"
#include "tilepress/whole_file.h"

namespace tilepress {
namespace {

/// The rows of schemes.csv per scheme, each with the header.
Result<std::map<std::string, std::string>> rows_by_scheme(const std::string& text) {
  CsvRecords records(text);
  const auto place = records.find("scheme");
  if (!place) return Error{ErrorKind::kFile, "has no column scheme"};
  const std::string header = text.substr(0, records.offset());
  std::map<std::string, std::string> out;
  for (size_t begin = records.offset(); records.next(); begin = records.offset()) {
    const std::string* scheme = records.field(*place);
    if (scheme == nullptr) return records.fault("scheme", "the field is missing");
    std::string& rows = out.try_emplace(*scheme, header).first->second;
    rows.append(text, begin, records.offset() - begin);
  }
  return out;
}

/// Tile and burst change rows, so that they must be those of the study.
Result<void> check_options(const std::string& run_path, const ModelOptions& model) {
  const auto options = run_document(run_path)["options"];
  const std::pair<const char*, uint32_t> wanted[] = {{"tile", model.tile_side}, {"burst_bits", model.burst_bits},
                                                     {"burst", model.burst_bits}};
  for (const auto& [name, value] : wanted) {
    const auto found = options.find(name);
    if (found == options.end() || !found->is_number_unsigned() || *found == value) continue;
    return Error{ErrorKind::kBadValue, "was made with " + std::string(name) + " " + found->dump() + ", not " +
                                           std::to_string(value) + " as the study"};
  }
  return {};
}

}  // namespace

Result<void> import_run(const Workload& workload, const StudyFile& study, const StudyOptions& options,
                        WorkloadRecord& record) {
  const std::string& path = workload.paths[0];
  const auto run = read_run(path);
  if (!run) return run.error();
  if (const auto fits = check_options(path, options.run.model); !fits) return fits;
  const auto text = read_whole_file(path + "/schemes.csv"), frames = read_whole_file(path + "/frames.csv");
  if (!text || !frames) return (text ? frames : text).error();
  const auto digest = sha256_of_bytes(*text);
  if (!digest) return digest.error();
  const auto rows = rows_by_scheme(*text);
  if (!rows) return about(path + "/schemes.csv", rows.error());
  record.source_sha256 = record.frames_digest = *digest;
  record.frames = run->frames.size();
  record.gl_renderer = run->info.gl_renderer;
  record.gl_version = run->info.gl_version;
  record.rendered = run->started;

  std::map<std::string, const std::string*> known;  // by canonical text
  for (const auto& [scheme, scheme_rows] : *rows)
    if (const auto spec = parse_scheme(scheme)) known.emplace(canonical_text(*spec), &scheme_rows);
  const ResultStore store(options.folder, options.run, workload.name, *digest);
  size_t missing = 0;
  for (const SchemeSpec& spec : study.configurations) {
    const auto found = known.find(canonical_text(spec));
    missing += found == known.end();
    if (found == known.end()) continue;
    const auto stored = store_text_file(store.result_path(spec), *found->second);
    if (!stored) return stored;
  }
  if (const auto stored = store_text_file(store.frames_path(), *frames); !stored) return stored;
  if (run->state != "finished")
    record.reason = "the run is " + run->state;
  else if (missing > 0)
    record.reason = "the run lacks " + std::to_string(missing) + " of " +
                    counted(study.configurations.size(), "configuration");
  if (!record.reason.empty()) record.state = "partial";
  return {};
}

}  // namespace tilepress
