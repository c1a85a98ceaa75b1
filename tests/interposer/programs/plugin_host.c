/* plugin_host PLUGIN ARGUMENTS…: opens a plugin that is linked to libEGL, locally, and runs its picture_main.
 */
#include <dlfcn.h>
#include <stdio.h>

int main(int argc, char** argv) {
  void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (plugin == NULL) return 9;
  int (*picture_main)(int, char**) = (int (*)(int, char**))dlsym(plugin, "picture_main");
  return picture_main != NULL ? picture_main(argc - 1, argv + 1) : 9;
}
