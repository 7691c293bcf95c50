# Debian packages: the library under a name that changes with its soname, what programs are built
# with, and the command. Made by: cmake --workflow --preset package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The authors of weartrack <weartrack@localhost>" CACHE STRING
    "who makes the packages: NAME <ADDRESS>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "wear-track rubber against bulk rubber")
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/package_documents.cmake)
set(CPACK_COMPONENTS_ALL library development tools)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(same_version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libweartrack${abi})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION 
"The library behind the command weartrack: readers of instrument files, fits,
friction and the modified layer of a wear track.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libweartrack-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libweartrack${abi} (= ${same_version})")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION 
"What a C program is built with that uses libweartrack: headers, the CMake
package and the file for pkg-config.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME weartrack)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libweartrack${abi} (>= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS "gwyddion, snakemake")
set(CPACK_COMPONENT_TOOLS_DESCRIPTION 
"The command. It reads AFM force curves, DMA sweeps and power spectra as
instruments export them and answers on one page whether there is a modified
layer in the wear track, how different it is, how thick it will be and what it
does to friction.")

include(CPack)
