// Shim process: starts the program, reads two pipes to their ends, and reads the run folders.
#include "shim_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "tilepress/run_lock.h"

namespace tilepress::testing {
namespace fs = std::filesystem;
namespace {

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<std::map<std::string, std::string>> read_table(const fs::path& path) {
  std::vector<std::map<std::string, std::string>> rows;
  const std::vector<std::string> lines = split(read_file(path), '\n');
  if (lines.empty()) return rows;
  const std::vector<std::string> names = split(lines[0], ',');
  for (size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> fields = split(lines[i], ',');
    std::map<std::string, std::string>& row = rows.emplace_back();
    for (size_t c = 0; c < names.size() && c < fields.size(); ++c) row[names[c]] = fields[c];
  }
  return rows;
}

void read_both(int out, int err, ProcessResult& result) {
  pollfd files[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
  std::string* texts[2] = {&result.out, &result.err};
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    if (poll(files, 2, -1) < 0) break;
    for (int i = 0; i < 2; ++i) {
      if (files[i].revents == 0) continue;
      char buffer[4096];
      const ssize_t count = read(files[i].fd, buffer, sizeof buffer);
      if (count > 0)
        texts[i]->append(buffer, static_cast<size_t>(count));
      else
        files[i].fd = -1;
    }
  }
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "tilepress-shim-XXXXXX").string();
  path_ = mkdtemp(name.data());
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool ProcessResult::exited_with(int code) const {
  return WIFEXITED(status) && WEXITSTATUS(status) == code;
}
bool ProcessResult::killed_by(int signal) const {
  return WIFSIGNALED(status) && WTERMSIG(status) == signal;
}

ProcessResult run_process(const std::vector<std::string>& command,
                          const std::map<std::string, std::string>& environment) {
  int out[2], err[2];
  if (pipe2(out, O_CLOEXEC) != 0 || pipe2(err, O_CLOEXEC) != 0) return {};
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    for (const auto& [name, value] : environment)
      value.empty() ? unsetenv(name.c_str()) : setenv(name.c_str(), value.c_str(), 1);
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    alarm(100);  // ends a program that hangs, and the test with it
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  ProcessResult result;
  read_both(out[0], err[0], result);
  waitpid(child, &result.status, 0);
  close(out[0]);
  close(err[0]);
  return result;
}

const std::string& own_display() {
  static struct Server {
    pid_t process = -1;
    std::string display;
    Server() {
      int number[2];
      if (pipe(number) != 0) return;
      process = fork();
      if (process == 0) {
        const int silent = open("/dev/null", O_RDWR);
        dup2(silent, STDOUT_FILENO);
        dup2(silent, STDERR_FILENO);
        close(number[0]);
        execlp("Xvfb", "Xvfb", "-displayfd", std::to_string(number[1]).c_str(), "-screen", "0", "800x1300x24",
               "-nolisten", "tcp", "-noreset", nullptr);
        _exit(127);
      }
      close(number[1]);
      std::string digits;
      for (char c; read(number[0], &c, 1) == 1 && c != '\n';) digits += c;
      close(number[0]);
      if (!digits.empty()) display = ":" + digits;
    }
    ~Server() {
      if (process <= 0) return;
      kill(process, SIGTERM);
      waitpid(process, nullptr, 0);
    }
  } server;
  return server.display;
}

std::string CapturedRun::json_text(const std::string& key) const {
  const size_t at = json.find("\"" + key + "\"");
  if (at == std::string::npos) return "";
  const size_t begin = json.find('"', json.find(':', at)) + 1;
  return json.substr(begin, json.find('"', begin) - begin);
}

int64_t CapturedRun::json_number(const std::string& key) const {
  const size_t at = json.find("\"" + key + "\"");
  return at == std::string::npos ? -1 : std::atoll(json.c_str() + json.find(':', at) + 1);
}

ShimRun ShimTest::run(const std::vector<std::string>& command,
                      std::map<std::string, std::string> environment) {
  const fs::path output = folder_.path() / "out", session = folder_.path() / "session";
  fs::create_directories(session);
  const std::string libraries = fs::path(TILEPRESS_PRELOAD).parent_path().string();
  environment.try_emplace("LD_PRELOAD", road_ == Road::kGlvnd ? "" : TILEPRESS_PRELOAD);
  if (road_ != Road::kPreload) {
    environment["__EGL_VENDOR_LIBRARY_FILENAMES"] = libraries + "/egl_vendor.json";
    environment["__GLX_VENDOR_LIBRARY_NAME"] = "tilepress";
    environment["LD_LIBRARY_PATH"] = libraries;
  }
  environment.try_emplace("TILEPRESS_OUT", output.string());
  environment.try_emplace("TILEPRESS_SESSION", session.string());
  environment.try_emplace("TILEPRESS_LOG_FILE", (folder_.path() / "log").string());
  environment.try_emplace("TILEPRESS_SCHEME", "vdcp red");
  environment.try_emplace("TILEPRESS_DUMP_FRAMES", "every:1");
  ShimRun result;
  result.process = run_process(command, environment);
  if (fs::exists(output))
    for (const auto& entry : fs::directory_iterator(output)) {
      wait_for_writer(entry.path().string(), true);
      result.runs.push_back(
          {entry.path(), read_table(entry.path() / "frames.csv"), read_table(entry.path() / "schemes.csv"),
           read_table(entry.path() / "presents.csv"), read_table(entry.path() / "surfaces.csv"),
           read_file(entry.path() / "run.json")});
    }
  std::sort(result.runs.begin(), result.runs.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  for (const auto& entry : fs::directory_iterator(session))
    if (entry.path().extension() == ".seen")
      for (const std::string& line : split(read_file(entry.path()), '\n')) result.seen.push_back(line);
  std::sort(result.seen.begin(), result.seen.end());
  result.log = read_file(folder_.path() / "log");
  return result;
}

std::vector<uint8_t> ShimTest::dump(uint32_t surface, uint64_t frame) const {
  std::string number = std::to_string(frame);
  number.insert(0, 6 - std::min<size_t>(6, number.size()), '0');
  const std::string name = std::to_string(surface) + "-" + number + ".rgba";
  fs::path newest;
  std::error_code no_run;
  for (const auto& run : fs::directory_iterator(folder_.path() / "out", no_run)) {
    const fs::path path = run.path() / "frames" / name;
    if (fs::exists(path) && (newest.empty() || fs::last_write_time(path) >= fs::last_write_time(newest)))
      newest = path;
  }
  const std::string bytes = newest.empty() ? "" : read_file(newest);
  return {bytes.begin(), bytes.end()};
}

ShimRun soak_windows(const char* api, std::map<std::string, std::string> environment) {
  environment.insert({{"TILEPRESS_SCHEME", "vdcp"},
                      {"TILEPRESS_DUMP_FRAMES", ""},
                      {"LP_NUM_THREADS", "0"},
                      {"DISPLAY", own_display()}});
  ShimTest test;
  ShimRun run = test.run({TILEPRESS_WINDOW_SOAK, api, "400"}, environment);
  EXPECT_TRUE(run.process.exited_with(0)) << run.process.err;
  long early_kib = 0, late_kib = 0;
  int early[2] = {}, late[2] = {1, 1}, texture = 0;
  EXPECT_EQ(sscanf(run.process.out.c_str(),
                   "%ld KiB, %d descriptors, %d threads\n%ld KiB, %d descriptors, %d threads\ntexture %d",
                   &early_kib, &early[0], &early[1], &late_kib, &late[0], &late[1], &texture),
            7)
      << run.process.out;
  // 320 windows and 1280 frames lie between the two. Leaking one frame of each window (8 KiB at least) would
  // add 2.5 MiB, a pixel buffer of each frame 10 MiB, a context of each window (more than 100 KiB) 32 MiB.
  // After the first 80 windows the shim holds as many as it ever does.
  EXPECT_LT(late_kib - early_kib, 2000) << run.process.out;
  EXPECT_EQ(late[0], early[0]) << run.process.out;
  EXPECT_EQ(late[1], early[1]) << run.process.out;
  EXPECT_EQ(texture, 1);
  return run;
}

}  // namespace tilepress::testing
