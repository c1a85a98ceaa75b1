/* plugin_host PLUGIN ARGUMENTS…: opens a plugin that is linked to libEGL, locally, and runs its picture_main.
 */
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

int main(int argc, char** argv) {
  const int deep = argc > 1 && strcmp(argv[1], "deepbind") == 0;
  argc -= deep;
  argv += deep;
  void* plugin = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL | (deep ? RTLD_DEEPBIND : 0));
  if (plugin == NULL) return 9;
  int (*picture_main)(int, char**) = (int (*)(int, char**))dlsym(plugin, "picture_main");
  return picture_main != NULL ? picture_main(argc - 1, argv + 1) : 9;
}
