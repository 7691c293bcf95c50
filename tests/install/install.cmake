# Installs into an empty prefix, moves it, builds and runs a small consumer with the CMake package and
# with pkg-config, and runs the installed command. Library, CMake package and .pc file have the properties
# that the head of core.h promises.
# Run: cmake -DBUILD=.. -DSOURCE=.. -DWORK=.. -DCC=.. -DREADELF=.. -DVERSION=.. -DCFLAGS=..
#            -DGENERATOR=.. -P install.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE rc OUTPUT_VARIABLE out ERROR_VARIABLE err)
  if(NOT rc EQUAL 0)
    list(JOIN ARGV " " text)
    message(FATAL_ERROR "${text}\nfailed (${rc}):\n${out}\n${err}")
  endif()
  set(output "${out}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
# No installed file contains the path of its installation or build.
file(RENAME ${WORK}/first ${WORK}/moved)
set(prefix ${WORK}/moved)

file(GLOB_RECURSE installed RELATIVE ${prefix} "${prefix}/*")
foreach(pattern IN ITEMS "^bin/weartrack$" "^lib/.*libweartrack\\.so" "^include/weartrack/core\\.h$"
        "^include/weartrack/weartrack\\.h$" "weartrack\\.pc$" "weartrack-config\\.cmake$"
        "share/man/man1/weartrack\\.1$" "share/man/man1/weartrack-run\\.1$"
        "share/man/man5/weartrack-case\\.5$" "share/man/man7/weartrack-tutorial\\.7$" "share/man/man3/weartrack-friction\\.3$"
        "share/man/man3/wt_friction_compute\\.3$" "share/bash-completion/completions/weartrack$"
        "share/zsh/site-functions/_weartrack$" "share/weartrack/formats/.*\\.xml$"
        "share/weartrack/formats/weartrack-format\\.xsd$"
        "share/weartrack/formats/weartrack-case\\.xsd$" "share/weartrack/styles/.*\\.gp$"
        "share/weartrack/campaign/Snakefile$")
  set(matching ${installed})
  list(FILTER matching INCLUDE REGEX "${pattern}")
  if(NOT matching)
    message(SEND_ERROR "not installed: ${pattern}")
  endif()
endforeach()
foreach(file IN LISTS installed)
  # sanitizers store names of source files for their reports
  if(CFLAGS MATCHES "-fsanitize")
    break()
  endif()
  if(file MATCHES "\\.(so[.0-9]*|h|pc|cmake|xml|xsd|gp|1|5)$" OR file STREQUAL "bin/weartrack")
    file(STRINGS ${prefix}/${file} hits REGEX "${SOURCE}/")
    if(hits)
      message(SEND_ERROR "${file} holds the path of the source folder")
    endif()
  endif()
endforeach()

# The loader has one folder: that of the library relative to the command.
file(GLOB library ${prefix}/lib*/libweartrack.so ${prefix}/lib*/*/libweartrack.so)
foreach(file IN ITEMS ${prefix}/bin/weartrack ${library})
  run(${READELF} -d ${file})
  string(REGEX MATCHALL "(RPATH|RUNPATH|SONAME)[^\n]*" entries "${output}")
  list(FILTER entries EXCLUDE REGEX "R(UN)?PATH.*\\[\\$ORIGIN/\\.\\./lib[a-z0-9_/-]*\\]$")
  list(APPEND dynamic ${entries})
endforeach()
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)" version "${VERSION}")
set(abi ${CMAKE_MATCH_1})
if(abi EQUAL 0)
  set(abi ${version})
endif()
if(NOT dynamic MATCHES "^SONAME[^[]*\\[libweartrack\\.so\\.([0-9.]+)\\]$" OR NOT CMAKE_MATCH_1 STREQUAL abi)
  message(SEND_ERROR "the soname does not end in ${abi}, or a folder of libraries is named: ${dynamic}")
endif()

# The CMake package accepts the same versions as the soname.
file(GLOB_RECURSE version_file "${prefix}/*/weartrack-config-version.cmake")
function(check_fits major minor expected)
  set(PACKAGE_FIND_VERSION ${major}.${minor})
  set(PACKAGE_FIND_VERSION_MAJOR ${major})
  set(PACKAGE_FIND_VERSION_MINOR ${minor})
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
  include(${version_file})
  if(NOT PACKAGE_VERSION_COMPATIBLE STREQUAL expected)
    message(SEND_ERROR "find_package(weartrack ${major}.${minor}) is not ${expected} for ${VERSION}")
  endif()
endfunction()
string(REPLACE "." ";" parts ${version})
list(GET parts 0 major)
list(GET parts 1 minor)
math(EXPR older "${minor} - 1")
math(EXPR newer "${minor} + 1")
check_fits(${major} ${minor} TRUE)
check_fits(${major} ${newer} FALSE)
if(major EQUAL 0)
  check_fits(0 ${older} FALSE)
endif()

separate_arguments(flags UNIX_COMMAND "${CFLAGS}")
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S ${SOURCE}/tests/install/consumer -B ${WORK}/cmake
    -DCMAKE_C_COMPILER=${CC} "-DCMAKE_C_FLAGS=${CFLAGS}" -DCMAKE_PREFIX_PATH=${prefix})
run(${CMAKE_COMMAND} --build ${WORK}/cmake)
run(${WORK}/cmake/consumer)
if(NOT output MATCHES "^weartrack [0-9]+\\.[0-9]+\\.[0-9]+: G")
  message(FATAL_ERROR "the consumer says: ${output}")
endif()

file(GLOB_RECURSE pc "${prefix}/*/weartrack.pc")
get_filename_component(pc_dir ${pc} DIRECTORY)
set(ENV{PKG_CONFIG_PATH} ${pc_dir})
run(pkg-config --cflags --libs weartrack)
string(STRIP "${output}" pc_flags)
separate_arguments(pc_flags UNIX_COMMAND "${pc_flags}")
get_filename_component(lib_dir ${pc_dir} DIRECTORY)
run(${CC} -std=c17 ${flags} ${SOURCE}/tests/install/consumer/consumer.c -o ${WORK}/by_pc ${pc_flags} -lm
    -Wl,-rpath,${lib_dir})
run(${WORK}/by_pc)
# the program of src/PACKAGES.md
file(READ ${SOURCE}/src/PACKAGES.md packages)
string(REGEX MATCH "```c\n([^`]*)```" program "${packages}")
file(WRITE ${WORK}/tip.c "${CMAKE_MATCH_1}")
run(${CC} ${flags} ${WORK}/tip.c ${pc_flags} -o ${WORK}/tip -Wl,-rpath,${lib_dir})
run(${WORK}/tip)
if(NOT output MATCHES "^force at 70 nm and 5 MPa: [1-9][0-9.]* nN\n$")
  message(FATAL_ERROR "the program of src/PACKAGES.md says: ${output}")
endif()
run(${prefix}/bin/weartrack --version)
if(NOT output MATCHES "^weartrack [0-9]")
  message(FATAL_ERROR "the installed command says: ${output}")
endif()
run(${prefix}/bin/weartrack formats list)

# The default build is optimised. The library folder is outside the prefix; the .pc file states both.
unset(ENV{CMAKE_BUILD_TYPE})
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S ${SOURCE} -B ${WORK}/plain -DCMAKE_C_COMPILER=${CC}
    -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/opt/weartrack -DCMAKE_INSTALL_LIBDIR=/usr/lib64)
file(STRINGS ${WORK}/plain/CMakeCache.txt type REGEX "^CMAKE_(BUILD_TYPE|CONFIGURATION_TYPES):")
if(NOT type MATCHES "=.*Release")
  message(SEND_ERROR "configured without a build type: ${type}")
endif()
foreach(pair IN ITEMS libdir=/usr/lib64 includedir=/opt/weartrack/include prefix=/opt/weartrack)
  string(REGEX MATCH "^(.*)=(.*)$" pair ${pair})
  run(pkg-config --variable=${CMAKE_MATCH_1} ${WORK}/plain/src/weartrack.pc)
  string(STRIP "${output}" output)
  if(NOT output STREQUAL CMAKE_MATCH_2)
    message(SEND_ERROR "weartrack.pc: ${pair} expected, ${output} found")
  endif()
endforeach()
