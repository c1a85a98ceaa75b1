# Runs before each package is built: brings the staged files of the components into Debian's places.
set(here ${CMAKE_CURRENT_LIST_DIR})
set(tree ${here}/../..)
file(READ ${tree}/CHANGELOG.md changes)

# The time of every file, and of the entry in the Debian changelog: SOURCE_DATE_EPOCH, else the day of the release.
string(REGEX MATCH "## [^ ]+ \\(([0-9-]+)\\)" heading "${changes}")
set(date "${CMAKE_MATCH_1}T12:00:00Z")
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  set(date "@$ENV{SOURCE_DATE_EPOCH}")
endif()
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_VARIABLE output OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(output "${output}" PARENT_SCOPE)
endfunction()
run(env LC_ALL=C date --utc -R "--date=${date}")
set(day "${output}")

# Debian packages whose code or font the binaries of a component contain. Their licences go along.
set(contained_command fonts-dejavu-core libcli11-dev libfmt-dev libhwy-dev libspdlog-dev libstb-dev
    libtomlplusplus-dev libxxhash-dev nlohmann-json3-dev)
set(contained_codec libhwy-dev)
set(contained_python libhwy-dev pybind11-dev)

foreach(component ${CPACK_COMPONENTS_ALL})
  set(stage ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(doc ${stage}/usr/share/doc/${package})

  # Debian's Python and zsh look elsewhere below /usr than below /usr/local.
  file(GLOB python_folders ${stage}/usr/lib/python3.*)
  foreach(folder ${python_folders})
    file(RENAME ${folder} ${stage}/usr/lib/python3)
  endforeach()
  if(EXISTS ${stage}/usr/share/zsh/site-functions)
    file(RENAME ${stage}/usr/share/zsh/site-functions ${stage}/usr/share/zsh/vendor-completions)
  endif()

  file(MAKE_DIRECTORY ${doc})
  file(COPY_FILE ${here}/copyright ${doc}/copyright)
  foreach(contained ${contained_${component}})
    file(MAKE_DIRECTORY ${doc}/contained)
    file(COPY_FILE /usr/share/doc/${contained}/copyright ${doc}/contained/${contained})
  endforeach()
  file(WRITE ${doc}/changelog "${changes}")
  file(WRITE ${doc}/changelog.Debian "${package} (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium

  * The release ${CPACK_PACKAGE_VERSION}. The file changelog.gz has the changes.

 -- ${CPACK_PACKAGE_CONTACT}  ${day}
")
  file(GLOB pages ${stage}/usr/share/man/man1/*.1)
  run(gzip -9nf ${doc}/changelog ${doc}/changelog.Debian ${pages})
  if(EXISTS ${here}/${package}.lintian-overrides)
    file(MAKE_DIRECTORY ${stage}/usr/share/lintian/overrides)
    file(COPY_FILE ${here}/${package}.lintian-overrides ${stage}/usr/share/lintian/overrides/${package})
  endif()

  # cpack strips programs and shared libraries only.
  file(GLOB archives ${stage}/usr/lib/*.a)
  if(archives)
    run(strip --strip-debug --enable-deterministic-archives --remove-section=.comment ${archives})
  endif()
  # The packages do not depend on the umask.
  run(chmod -R u+rwX,go+rX,go-w ${stage}/usr)
  run(find ${stage} -exec touch --no-dereference "--date=${date}" {} +)
endforeach()
