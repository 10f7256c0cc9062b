# cpack -G DEB runs this between the installation into its folders and the
# packages: the man page is compressed, and every package gets its copyright
# and changelogs.
if(NOT CPACK_GENERATOR STREQUAL DEB)
  return()
endif()

function(compress file)
  execute_process(COMMAND gzip -9nf ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

# The changelog of the Debian packages: one entry, from the date of the release.
file(STRINGS ${CPACK_SPALL_SOURCE}/CITATION.cff day REGEX "^date-released:")
string(REPLACE "date-released: " "" day "${day}")
execute_process(COMMAND env LC_ALL=C date -u -R -d ${day}
  OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE
  COMMAND_ERROR_IS_FATAL ANY)
set(debian_changelog "\
spall (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; \
urgency=medium

  * Packages of version ${CPACK_PACKAGE_VERSION}, made by cpack.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share)
  set(doc ${root}/doc/${package})
  file(COPY ${CPACK_SPALL_SOURCE}/scripts/debian/copyright DESTINATION ${doc}
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(WRITE ${doc}/changelog.Debian "${debian_changelog}")
  configure_file(${CPACK_SPALL_SOURCE}/docs/CHANGELOG.md ${doc}/changelog
    COPYONLY)
  compress(${doc}/changelog)
  compress(${doc}/changelog.Debian)
endforeach()

set(share ${CPACK_TEMPORARY_DIRECTORY}/program/usr/share)
compress(${share}/man/man1/spall.1)
# The shell of Debian looks here.
file(MAKE_DIRECTORY ${share}/zsh)
file(RENAME ${share}/zsh/site-functions ${share}/zsh/vendor-completions)
# Part of the file copyright.
file(REMOVE ${share}/doc/spall/LICENSE ${share}/doc/spall/NOTICE)
