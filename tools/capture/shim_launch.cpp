// Shim launch: a run's options and a session, as environment variables.
#include "capture/shim_launch.h"

#include "capture/shim_path.h"

namespace tilepress {

Result<std::string> preloadable_shim(bool all_targets, TemporaryFolder& links) {
  const auto shim = find_shim(all_targets ? "libtilepress-preload-gl.so" : "libtilepress-preload.so");
  if (!shim) return shim;
  return preloadable(*shim, links);
}

Result<std::map<std::string, std::string>> shim_variables(const RunOptions& options,
                                                          const SessionFolder& session, ShimRoad road,
                                                          const std::string& library) {
  RunOptions logged = options;
  logged.log_file = session.log_path();
  std::map<std::string, std::string> variables = to_environment(logged);
  variables["TILEPRESS_SESSION"] = session.path();
  if (const auto added = add_shim_environment(variables, road, library); !added) return added.error();
  return variables;
}

}  // namespace tilepress
