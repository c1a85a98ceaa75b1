// Slurm: sbatch is called twice, for the array and for the merge.
#include "slurm.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "capture/child_process.h"
#include "study/text_file.h"
#include "tilepress/program_search.h"
#include "tilepress/whole_file.h"
#include "way_out.h"

namespace tilepress {
namespace {

namespace fs = std::filesystem;

/// Runs sbatch and returns the number of the job that it prints.
Result<std::string> sbatch(const std::string& folder, const std::vector<std::string>& arguments) {
  const std::string answer = folder + "/slurm/job-number";
  std::vector<std::string> argv = {"/bin/sh", "-c", "exec sbatch --parsable \"$@\" > \"$0\"", answer};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  const auto end = run_child(argv, {});
  if (!end) return end.error();
  if (end->status() != 0) return Error{ErrorKind::kSystem, "sbatch: exit status " + std::to_string(end->status())};
  const auto text = read_whole_file(answer);
  if (!text) return text.error();
  // "number" or "number;cluster"
  return text->substr(0, text->find_first_of(";\n"));
}

/// The most elements of an array that Slurm's default configuration takes.
constexpr size_t kMostArrayTasks = 1000;

/// "1-4,7": sbatch's --array for the shards that hold any of these tasks.
std::string array_text(const std::vector<size_t>& tasks, uint32_t shard_count) {
  std::set<size_t> shards;
  for (const size_t task : tasks) shards.insert(task % shard_count + 1);
  std::string out;
  for (auto at = shards.begin(); at != shards.end();) {
    const size_t first = *at;
    size_t last = first;
    while (++at != shards.end() && *at == last + 1) ++last;
    out += fmt::format("{}{}", out.empty() ? "" : ",", first);
    if (last > first) out += fmt::format("-{}", last);
  }
  return out;
}

/// The script of the array job. An element runs one shard of `shard_count`.
std::string job_script(const StudyPlan& plan, const StudyOptions& options, const std::string& command,
                       uint32_t shard_count) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Runs one part of a study; `tilepress study` wrote this file and submitted it.\n"
      "#SBATCH --job-name=tilepress-{}\n"
      "exec {} study retry {} --shard \"$SLURM_ARRAY_TASK_ID/{}\" -j \"${{SLURM_CPUS_PER_TASK:-1}}\" \\\n"
      "  --progress never\n",
      plan.study.name, shell_word(command), shell_word(options.folder), shard_count);
}

}  // namespace

Result<std::string> submit_to_slurm(const StudyPlan& plan, const StudyOptions& options,
                                    const std::vector<size_t>& tasks) {
  if (const auto found = find_program("sbatch"); !found)
    return Error{ErrorKind::kFile, "--launcher slurm: sbatch is not there"};
  std::error_code code;
  const std::string command = fs::read_symlink("/proc/self/exe", code).string();
  // One shard per task, or fewer, larger ones.
  const auto shard_count = static_cast<uint32_t>(std::clamp<size_t>(plan.tasks.size(), 1, kMostArrayTasks));
  const std::string folder = options.folder, script = folder + "/slurm/job.sh";
  const auto stored = store_text_file(script, job_script(plan, options, command, shard_count));
  if (!stored) return stored.error();
  auto job = sbatch(folder, {"--array=" + array_text(tasks, shard_count),
                             "--output=" + folder + "/slurm/%A-%a.log", "--chdir=" + folder, script});
  if (!job) return job;
  const std::string merge = shell_word(command) + " study merge " + shell_word(folder);
  const auto merging = sbatch(folder, {"--dependency=afterany:" + *job, "--job-name=tilepress-merge",
                                       "--output=" + folder + "/slurm/%j-merge.log", "--chdir=" + folder,
                                       "--wrap=" + merge});
  return merging ? job : merging;
}

}  // namespace tilepress
