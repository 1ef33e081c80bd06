# cpack runs this on the files of a package before it packs them. Debian wants manual pages and changelog compressed and
# a copyright file in each package; all packages want the same times and permissions whenever and by whomever they are
# made.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(top ${CPACK_TEMPORARY_DIRECTORY})
if(CPACK_GENERATOR STREQUAL "DEB")
  file(READ ${CPACK_RESOURCE_FILE_LICENSE} license)
  string(REGEX REPLACE "\n+$" "" license "${license}")
  string(REGEX MATCH "Copyright \\(c\\) ([^\n]+)" found "${license}")
  set(holder "${CMAKE_MATCH_1}")
  string(REGEX REPLACE "^MIT License\n+Copyright[^\n]+\n+" "" license "${license}")
  string(REPLACE "\n\n" "\n.\n" license "${license}")
  string(REPLACE "\n" "\n " license "${license}")
  set(date "@0")
  if(DEFINED ENV{SOURCE_DATE_EPOCH})
    set(date "@$ENV{SOURCE_DATE_EPOCH}")
  endif()
  execute_process(COMMAND env LC_ALL=C date --utc -R -d ${date} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)
  foreach(part ${CPACK_COMPONENTS_ALL})
    string(TOUPPER ${part} PART)
    set(package ${CPACK_DEBIAN_${PART}_PACKAGE_NAME})
    set(doc ${top}/${part}/usr/share/doc/${package})
    file(WRITE ${doc}/changelog.Debian
      "${package} (${CPACK_DEBIAN_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
      "  * The changelog of lancer tells what changed.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
    run(gzip -9 --no-name ${doc}/changelog.Debian)
    file(WRITE ${doc}/copyright
      "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: lancer\n\n"
      "Files: *\nCopyright: ${holder}\nLicense: Expat\n\nLicense: Expat\n ${license}\n")
  endforeach()
  set(doc ${top}/program/usr/share/doc/lancer)
  file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
  file(REMOVE ${doc}/LICENSE)
  file(GLOB compressed ${top}/program/usr/share/man/man1/*.1 ${doc}/changelog)
  run(gzip -9 --no-name ${compressed})
endif()

run(chmod -R u+rwX,go+rX,go-w ${top})
if(DEFINED ENV{SOURCE_DATE_EPOCH})
  run(find ${top} -exec touch --no-dereference --date=@$ENV{SOURCE_DATE_EPOCH} "{}" +)
endif()
