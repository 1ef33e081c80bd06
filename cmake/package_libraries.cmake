# cpack reads this before it makes packages. What the program is linked with is Depends, what only modules are linked
# with is Recommends: cpack's own search knows no difference.
if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
set(scratch ${CPACK_PACKAGE_DIRECTORY}/_CPack_Packages/shlibdeps)
file(WRITE ${scratch}/debian/control "Source: lancer\n\nPackage: lancer\nArchitecture: any\n")
execute_process(COMMAND dpkg-shlibdeps -O -dDepends ${CPACK_LANCER_PROGRAM} -dRecommends ${CPACK_LANCER_MODULES}
  WORKING_DIRECTORY ${scratch} OUTPUT_VARIABLE libraries ERROR_VARIABLE said RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT libraries MATCHES "shlibs:Depends=([^\n]+)")
  message(FATAL_ERROR "dpkg-shlibdeps (package dpkg-dev) tells no libraries: ${libraries}${said}")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${CMAKE_MATCH_1}")
if(libraries MATCHES "shlibs:Recommends=([^\n]+)")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "${CMAKE_MATCH_1}")
endif()
