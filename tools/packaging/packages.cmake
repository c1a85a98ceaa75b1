# The Debian packages that cpack makes, one for each install component.
#   command  tilepress             the command, the shim, the view, manual page, completion, recipes
#   codec    libtilepress-dev      the codec for C++ and C, CMake and pkg-config files
#   python   python3-tilepress     the Python module
# finish_packages.cmake brings the staged files into Debian's places.
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL command codec)
if(TARGET tilepress_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/finish_packages.cmake)

set(CPACK_PACKAGE_NAME tilepress)
set(CPACK_PACKAGE_VENDOR "The tilepress authors")
set(CPACK_PACKAGE_CONTACT "The tilepress authors <tilepress@tilepress.invalid>" CACHE STRING
    "Maintainer of the packages, with the address of who makes them")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME tilepress)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "framebuffer compression statistics of running GL programs
tilepress captures the frames of unmodified OpenGL and OpenGL ES programs
while they run, replays traces of apitrace without a display, and reads
images and movies. It computes for each frame how well lossless framebuffer
compression works on it: seven schemes of dynamic color palettes, those of
the literature and of shipping GPUs.")
# The corpus and the figures of studies are Python programs. The command itself needs what it links; `tilepress doctor`
# names the rest. eglretrace loads libEGL.so and libGLESv2.so, names that only the -dev packages have.
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS python3)
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS
    "apitrace, apitrace-tracers, libegl-dev, libgl1-mesa-dri, libgles-dev, python3-matplotlib, xauth, xvfb")
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS
    "dbus, faketime, glmark2-es2-x11, libtilepress-dev, matchbox-window-manager, python3-tilepress, xdotool")

set(CPACK_DEBIAN_CODEC_PACKAGE_NAME libtilepress-dev)
set(CPACK_DEBIAN_CODEC_PACKAGE_SECTION libdevel)
# The library of the C interface lies here too.
set(shlibs ${PROJECT_BINARY_DIR}/packaging/shlibs)
file(CONFIGURE OUTPUT ${shlibs} CONTENT "libtilepress 0 libtilepress-dev (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_CODEC_PACKAGE_CONTROL_EXTRA ${shlibs} ${CMAKE_CURRENT_LIST_DIR}/triggers)
set(CPACK_DEBIAN_CODEC_DESCRIPTION "framebuffer compression schemes as a library for C++ and C
The codec of tilepress: surfaces, tiles, schemes that measure, encode and
decode blocks, and a DRAM model. The package has the static library and
headers for C++20, the library libtilepress.so for C, the header for
plugins, and files for CMake and pkg-config.")
set(CPACK_DEBIAN_CODEC_PACKAGE_SUGGESTS tilepress)

if(TARGET tilepress_python)
  # The extension is compiled for one version of Python.
  string(REGEX MATCH "python3\\.([0-9]+)" version ${TILEPRESS_PYTHON_FOLDER})
  set(minor ${CMAKE_MATCH_1})
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tilepress)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${minor}~), python3 (<< 3.${next_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS python3-pandas)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS tilepress)
  set(CPACK_DEBIAN_PYTHON_DESCRIPTION "framebuffer compression schemes on numpy arrays
The codec of tilepress as a Python module: frames as numpy arrays in,
statistics, payloads and decoded images out. It reads runs and studies of
the command as DataFrames, and takes schemes written in Python.")
endif()
include(CPack)
