// tilepress doctor: checks this machine and names the Debian packages it lacks.
#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "capture/gl_probe.h"
#include "capture/shim_path.h"
#include "capture/shim_self_test.h"
#include "command_line.h"
#include "dram_text.h"
#include "tilepress/program_search.h"
#include "verb.h"
#include "way_out.h"

namespace tilepress {
namespace {

struct Finding {
  std::string what;
  bool found = false;
  bool essential = false;  ///< without it no program can be captured
  std::string detail;
  std::string package;  ///< Debian package that contains it
};

struct Tool {
  const char *name, *purpose, *package;
};
constexpr Tool kTools[] = {{"glretrace", "replays GLX traces on an X display", "apitrace"},
                           {"apitrace", "records traces", "apitrace"},
                           {"Xvfb", "an X server without a screen", "xvfb"},
                           {"xvfb-run", "runs a program in an Xvfb", "xvfb"},
                           {"xauth", "required by xvfb-run", "xauth"},
                           {"glmark2-es2", "a program to try, EGL", "glmark2-es2-x11"},
                           {"glmark2", "a program to try, GLX", "glmark2-x11"}};

bool file_contains(const std::string& path, const char* word) {
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  return content.find(word) != std::string::npos;
}

void add_gl(std::vector<Finding>& findings) {
  const GlProbe gl = probe_gl();
  findings.push_back({"EGL library", !gl.egl_version.empty(), true,
                      gl.egl_version.empty() ? gl.failure : "libEGL.so.1, " + gl.egl_version, "libegl1"});
  findings.push_back({"libglvnd", gl.glvnd, false,
                      gl.glvnd ? "libEGL dispatches to vendors" : "libEGL is not libglvnd: no vendor shim",
                      "libegl1"});
  const bool software =
      gl.renderer.find("llvmpipe") != std::string::npos || gl.renderer.find("softpipe") != std::string::npos;
  findings.push_back({"headless GL", gl.failure.empty(), false,
                      gl.failure.empty() ? fmt::format("{}, {} ({})", gl.renderer, gl.version,
                                                       software ? "software rendering" : "a GPU")
                                         : gl.failure,
                      "libgl1-mesa-dri"});
  const size_t mesa = gl.version.find("Mesa ");
  if (mesa != std::string::npos)
    findings.push_back({"Mesa", true, false, gl.version.substr(mesa + std::strlen("Mesa ")), ""});
  std::error_code code;
  std::string nodes;
  for (const auto& entry : std::filesystem::directory_iterator("/dev/dri", code))
    nodes += (nodes.empty() ? "" : ", ") + entry.path().string();
  findings.push_back({"GPU devices", !nodes.empty(), false,
                      nodes.empty() ? "none in /dev/dri: Mesa renders in software" : nodes, ""});
}

void add_displays(std::vector<Finding>& findings) {
  const char* display = std::getenv("DISPLAY");
  const bool named = display != nullptr && *display != '\0';
  const bool answers = named && x_server_answers(display);
  findings.push_back({"X display", answers, false,
                      !named    ? "DISPLAY is not set; xvfb-run -a gives a private one"
                      : answers ? display
                                : std::string(display) + " does not answer",
                      ""});
  const char* wayland = std::getenv("WAYLAND_DISPLAY");
  findings.push_back({"Wayland", wayland != nullptr, false,
                      wayland != nullptr ? wayland : "WAYLAND_DISPLAY is not set", ""});
}

Finding find_retracer() {
  const auto retracer = find_program("eglretrace");
  const bool waffle = retracer && file_contains(*retracer, "libwaffle");
  return {"eglretrace", waffle, false,
          !retracer ? "replays traces"
          : waffle  ? *retracer + ", with waffle: replays without a display"
                    : *retracer + " is built without waffle and needs a display",
          "apitrace"};
}

/// eglretrace loads these names, which only the -dev packages have.
Finding find_unversioned_library(const std::string& name, const std::string& package) {
  void* library = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
  const bool found = library != nullptr;
  if (found) dlclose(library);
  return {name, found, false, "eglretrace loads it", package};
}

/// Tests whether the shim gets into a program and captures it.
Finding test_road(const std::string& shim, ShimRoad road, bool essential, const char* how) {
  const auto passed = test_shim(shim, road);
  return {"capture", passed.has_value(), essential, how + (passed ? *passed : passed.error().text), ""};
}

std::vector<Finding> examine() {
  std::vector<Finding> findings;
  const auto shim = find_shim("libtilepress-preload.so");
  findings.push_back({"shim", shim.has_value(), true, shim ? *shim : shim.error().text, ""});
  add_gl(findings);
  if (shim) {
    findings.push_back(test_road(*shim, ShimRoad::kPreload, true, "preloaded: "));
    findings.push_back(test_road(*shim, ShimRoad::kGlvnd, false, "through libglvnd: "));
  }
  add_displays(findings);
  findings.push_back(find_retracer());
  findings.push_back(find_unversioned_library("libEGL.so", "libegl-dev"));
  findings.push_back(find_unversioned_library("libGLESv2.so", "libgles-dev"));
  for (const auto& [name, purpose, package] : kTools) {
    const auto path = find_program(name);
    findings.push_back({name, path.has_value(), false, path ? *path + ", " + purpose : purpose, package});
  }
  for (const DramPreset& preset : kDramPresets)
    findings.push_back({"DRAM " + std::string(preset.name), true, false, dram_text(preset), ""});
  return findings;
}

constexpr const char* kExamples =
    "Examples:\n"
    "  tilepress doctor\n"
    "  tilepress doctor --json\n"
    "  xvfb-run -a tilepress doctor\n";

}  // namespace

int verb_doctor(int argc, char** argv) {
  CLI::App app(
      "Checks what this machine has for capture and replay, and names missing packages. "
      "Exit 1 if no capture is possible.");
  app.footer(kExamples);
  bool json = false;
  app.add_flag("--json", json, "As JSON");
  if (auto status = parse_command_line(app, argc, argv)) return *status;

  const std::vector<Finding> findings = examine();
  bool capable = true;
  std::string packages;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    capable &= finding.found || !finding.essential;
    if (!finding.found && !finding.package.empty() &&
        packages.find(" " + finding.package) == std::string::npos)
      packages += " " + finding.package;
    if (json)
      list.push_back({{"what", finding.what},
                      {"found", finding.found},
                      {"detail", finding.detail},
                      {"package", finding.package}});
    else
      std::fputs(
          fmt::format("{:<8} {:<12} {}\n", finding.found ? "found" : "missing", finding.what, finding.detail)
              .c_str(),
          stdout);
  }
  if (json)
    std::printf("%s\n", list.dump(2).c_str());
  else if (!packages.empty())
    std::printf("\nTo get what is missing: apt-get install%s\n", packages.c_str());
  return capable ? kExitDone : kExitFailed;
}

}  // namespace tilepress
