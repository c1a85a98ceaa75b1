// Shim environment: finds the driver libraries that libglvnd would load, and puts a library of the shim in
// front of each.
#include "tilepress/shim_environment.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ranges>
#include <set>
#include <vector>

namespace tilepress {
namespace fs = std::filesystem;
namespace {

constexpr size_t kEglShims = 4;  // the shim's EGL vendor library and its copies

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::vector<std::string> split_path(const std::string& text) {
  std::vector<std::string> parts;
  for (const auto& part : std::views::split(text, ':'))
    if (!part.empty()) parts.emplace_back(part.begin(), part.end());
  return parts;
}

/// The vendor files of libglvnd's libEGL, in the order of libEGL.
std::vector<std::string> egl_vendor_files() {
  std::vector<std::string> files = split_path(variable("__EGL_VENDOR_LIBRARY_FILENAMES"));
  if (!files.empty()) return files;
  std::vector<std::string> folders = split_path(variable("__EGL_VENDOR_LIBRARY_DIRS"));
  if (folders.empty()) folders = {"/etc/glvnd/egl_vendor.d", "/usr/share/glvnd/egl_vendor.d"};
  for (const std::string& folder : folders) {
    std::vector<std::string> found;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code))
      if (entry.path().extension() == ".json") found.push_back(entry.path().string());
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

std::string library_of(const std::string& vendor_file) {
  std::ifstream file(vendor_file);
  const auto json = nlohmann::json::parse(file, nullptr, false);
  if (!json.is_object() || !json.contains("ICD") || !json["ICD"].is_object()) return "";
  const std::string library = json["ICD"].value("library_path", "");
  const bool relative = library.find('/') != std::string::npos && library.front() != '/';
  return relative ? (fs::path(vendor_file).parent_path() / library).string() : library;
}

/// The names X of libGLX_X.so.0 in the system's library folders, without those that are no driver.
std::set<std::string> glx_vendors() {
  std::set<std::string> names;
  for (const char* folder :
       {"/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib64", "/usr/lib"}) {
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code)) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with("libGLX_") || !name.ends_with(".so.0")) continue;
      const std::string vendor = name.substr(7, name.size() - 12);
      if (vendor != "indirect" && vendor != "system" && vendor != "tilepress") names.insert(vendor);
    }
  }
  return names;
}

/// The GLX vendor that libglvnd's libGLX takes: the user's choice, or the only installed vendor if libEGL
/// uses the same driver. Empty if unknown: with several vendors, the X server chooses one for each screen.
std::string glx_vendor(const std::string& wish, const std::set<std::string>& installed,
                       const std::vector<std::string>& egl_files) {
  if (!wish.empty()) return wish;
  if (installed.size() != 1) return "";
  const std::string beside = "libEGL_" + *installed.begin() + ".so.0";
  const bool fits = std::any_of(egl_files.begin(), egl_files.end(), [&](const std::string& file) {
    return fs::path(library_of(file)).filename() == beside;
  });
  return fits ? *installed.begin() : "";
}

fs::path vendor_folder(const std::string& preload_library) {
  std::error_code code;
  const fs::path beside = fs::path(preload_library).parent_path();
  for (const fs::path& folder : {beside, beside / "tilepress"})
    if (fs::exists(folder / "libEGL_tilepress.so.0", code) && fs::exists(folder / "egl_vendor.json", code))
      return folder;
  return {};
}

}  // namespace

Result<void> add_shim_environment(std::map<std::string, std::string>& environment, ShimRoad road,
                                  const std::string& preload_library) {
  if (road != ShimRoad::kGlvnd) {
    const std::string present = variable("LD_PRELOAD");
    environment["LD_PRELOAD"] = present.empty() ? preload_library : preload_library + ":" + present;
    // Without this flag, the shared runtime of the address sanitizer refuses a process with another library
    // before it. The preloaded library sets the flag too, unless the program has its own default options.
    const std::string asan = variable("ASAN_OPTIONS");
    environment["ASAN_OPTIONS"] = "verify_asan_link_order=0" + (asan.empty() ? "" : ":" + asan);
    if (road == ShimRoad::kPreload) return {};
  }
  const fs::path folder = vendor_folder(preload_library);
  std::vector<std::string> files = egl_vendor_files();
  const bool has_driver =
      std::any_of(files.begin(), files.end(), [](const auto& file) { return !library_of(file).empty(); });
  const std::set<std::string> glx_installed = glx_vendors();
  const std::string glx_wish = variable("__GLX_VENDOR_LIBRARY_NAME");
  const std::string glx = glx_vendor(glx_wish, glx_installed, files);
  // With several vendors, kAuto uses the preloaded library alone.
  const bool certain = files.size() == 1 && glx_wish.empty() && (!glx.empty() || glx_installed.empty());
  if (road == ShimRoad::kAuto && (folder.empty() || !has_driver || !certain)) return {};
  if (folder.empty())
    return Error{ErrorKind::kFile, "--via glvnd: libEGL_tilepress.so.0: not found beside " + preload_library};
  if (!has_driver)
    return Error{ErrorKind::kSystem, "--via glvnd: no EGL vendor library is installed (libglvnd)"};
  std::string list;
  std::set<std::string> drivers;  // libglvnd loads each once
  for (const std::string& file : files) {
    const std::string driver = library_of(file);
    if (!driver.empty() && !drivers.insert(driver).second) continue;
    const std::string number = drivers.size() > 1 ? "_" + std::to_string(drivers.size()) : "";
    const bool ours = !driver.empty() && drivers.size() <= kEglShims;
    if (ours) environment["TILEPRESS_EGL_VENDOR" + number] = driver;
    list += (list.empty() ? "" : ":") + (ours ? (folder / ("egl_vendor" + number + ".json")).string() : file);
  }
  environment["__EGL_VENDOR_LIBRARY_FILENAMES"] = list;
  if (!glx.empty()) {
    environment["__GLX_VENDOR_LIBRARY_NAME"] = "tilepress";
    environment["TILEPRESS_GLX_VENDOR"] = glx;
  }
  const std::string libraries = variable("LD_LIBRARY_PATH");
  environment["LD_LIBRARY_PATH"] = libraries.empty() ? folder.string() : folder.string() + ":" + libraries;
  return {};
}

}  // namespace tilepress
