# The top folder contains only the files listed here, so that no file of a test or an experiment is
# committed.
# Run: cmake -DSOURCE=<project folder> [-DPLANTED=ON] -P top.cmake
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

set(top CMakeLists.txt CMakePresets.json README.md LICENSE CHANGELOG.md src include formats tests
  fixtures man build)
file(GLOB entries RELATIVE "${SOURCE}" "${SOURCE}/*")
if(PLANTED)
  list(APPEND entries left_lying.h5)
endif()
list(FILTER entries EXCLUDE REGEX "^\\.|~$")
list(REMOVE_ITEM entries ${top})
if(entries)
  message(FATAL_ERROR "does not belong at the top: ${entries}; build in a folder named build")
endif()
