# Headers that many files include, compiled once for each set of flags. The release build goes without: there each file
# must include what it uses.
option(TILEPRESS_PRECOMPILE "Precompile the headers that many files include" OFF)
set(TILEPRESS_COMMON_HEADERS <algorithm> <array> <bit> <cstdint> <cstring> <memory> <optional> <span> <string> <utility>
    <vector>)

# tilepress_header_set(NAME [LIBRARIES library...] [OPTIONS option...] [HEADERS header...]): precompiles the common
# headers and these headers, with the flags of the libraries and these options.
function(tilepress_header_set name)
  cmake_parse_arguments(set "" "" "LIBRARIES;OPTIONS;HEADERS" ${ARGN})
  if(NOT TILEPRESS_PRECOMPILE OR TARGET tilepress_headers_${name})
    return()
  endif()
  file(TOUCH ${PROJECT_BINARY_DIR}/precompiled.cpp)
  add_library(tilepress_headers_${name} OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
  target_compile_options(tilepress_headers_${name} PRIVATE ${set_OPTIONS})
  target_link_libraries(tilepress_headers_${name} PRIVATE tilepress_warnings ${set_LIBRARIES})
  target_precompile_headers(tilepress_headers_${name} PRIVATE ${TILEPRESS_COMMON_HEADERS} ${set_HEADERS})
endfunction()

# Compiles the targets with the precompiled headers of a set. Their flags must be those of the set.
function(tilepress_use_headers name)
  if(TARGET tilepress_headers_${name})
    foreach(target ${ARGN})
      target_precompile_headers(${target} REUSE_FROM tilepress_headers_${name})
    endforeach()
  endif()
endfunction()

tilepress_header_set(sanitized LIBRARIES tilepress_sanitizers)
if(NOT TILEPRESS_CODEC_ONLY)
  tilepress_header_set(plain)
  find_package(fmt REQUIRED)
  tilepress_header_set(quick LIBRARIES tilepress_sanitizers tilepress_quick_compile fmt::fmt
                       HEADERS <cmath> <filesystem> <fmt/format.h> <fstream> <map>)
endif()
if(TILEPRESS_TESTS)
  find_package(GTest REQUIRED)
  tilepress_header_set(tests LIBRARIES tilepress_sanitizers GTest::gtest HEADERS <gtest/gtest.h>)
  tilepress_header_set(quick_tests LIBRARIES tilepress_sanitizers tilepress_quick_compile GTest::gtest
                       HEADERS <gtest/gtest.h>)
  tilepress_header_set(race_tests LIBRARIES GTest::gtest OPTIONS -fsanitize=thread HEADERS <gtest/gtest.h>)
endif()

# CLI11 is headers alone: each verb would compile all of it. After `#pragma interface` g++ leaves the member functions of a
# header out, and takes those that one file compiles for all others.
function(tilepress_share_cli11 target)
  if(NOT TILEPRESS_PRECOMPILE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    return()
  endif()
  set(folder ${PROJECT_BINARY_DIR}/shared_cli11)
  find_path(TILEPRESS_CLI11_INCLUDE CLI/CLI.hpp REQUIRED)
  file(GLOB headers RELATIVE ${TILEPRESS_CLI11_INCLUDE}/CLI ${TILEPRESS_CLI11_INCLUDE}/CLI/*.hpp)
  set(source "#include <CLI/CLI.hpp>\n")
  foreach(header ${headers})
    file(READ ${TILEPRESS_CLI11_INCLUDE}/CLI/${header} text)
    file(WRITE ${folder}/CLI/${header}.in "#pragma GCC system_header\n#pragma interface\n${text}")
    configure_file(${folder}/CLI/${header}.in ${folder}/CLI/${header} COPYONLY)
    string(PREPEND source "#pragma implementation \"${header}\"\n")
  endforeach()
  file(CONFIGURE OUTPUT ${folder}/cli11.cpp CONTENT "${source}" @ONLY)
  target_sources(${target} PRIVATE ${folder}/cli11.cpp)
  set_source_files_properties(${folder}/cli11.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  target_include_directories(${target} BEFORE PRIVATE ${folder})
endfunction()
