# No file uses a symbol of a slice above its own, and no computation accesses a file.
# Run: cmake -DOBJECTS=<file with the paths, one a line> -DNM=.. -P upward.cmake
# With -DPLANTED=ON an upward use and a computation that opens a file are added; both must be found.
# SPDX-License-Identifier: GPL-3.0-or-later
cmake_minimum_required(VERSION 3.25)

# Slices that each slice may use, without the core. layers.cmake has the same order for #include lines; a
# public header permits the use of a symbol without one.
set(below_core "")
set(below_report "")
set(below_read "")
set(below_job read)
set(below_dma job read)
set(below_surface job read)
set(below_indentation dma job read)
set(below_friction dma surface job read)
set(below_layer friction dma surface job read)
set(below_study indentation dma friction layer surface job read)
set(below_record study indentation layer friction dma surface job read)
set(below_case record study indentation layer friction dma surface job read report)
set(below_view case record study indentation layer friction dma surface job read report)
set(below_cmd view case record study indentation layer friction dma surface job read report)

# The registries name the functions of all slices.
set(registries core/table/registry.c report/figures.c)

# Functions of the C library that open, read or write files.
set(file_functions fopen fopen64 fdopen freopen fread fwrite fgets getline open open64 openat read pread
  pread64 write mmap mmap64 opendir stat unlink rename system popen)

if(PLANTED)
  set(PLANTED_NEEDS "wt_objects.dir/dma/rubber.c.o: U wt_run_defaults
wt_objects.dir/dma/numerics/peak.c.o: U fopen
")
endif()
include(${CMAKE_CURRENT_LIST_DIR}/object_symbols.cmake)

set(violations "")
foreach(file IN LISTS files)
  string(REGEX REPLACE "/.*" "" slice ${file})
  if(NOT DEFINED below_${slice})
    list(APPEND violations "${file}: ${slice} has no row in the table of slices")
  elseif(NOT file IN_LIST registries)
    foreach(other IN LISTS ties_${file})
      string(REGEX REPLACE "/.*" "" other_slice ${other})
      if(NOT other_slice STREQUAL slice AND NOT other_slice STREQUAL "core" AND
         NOT other_slice IN_LIST below_${slice} AND
         NOT (file MATCHES "/figures[a-z_]*\\.c$" AND other_slice STREQUAL "report") AND
         NOT (file MATCHES "/answer[a-z_]*\\.c$" AND other MATCHES "^case/answer/"))
        list(APPEND violations "${file} uses${by_${file}_${other}} of ${other}")
      endif()
    endforeach()
  endif()
  if(file MATCHES "/(numerics|law)/" OR file MATCHES "^core/math/")
    foreach(symbol IN LISTS undefined_${file})
      if(symbol IN_LIST file_functions)
        list(APPEND violations "${file}: a computation uses ${symbol}")
      endif()
    endforeach()
  endif()
endforeach()
if(violations)
  list(JOIN violations "\n  " text)
  message(FATAL_ERROR "symbols are used upwards, or a computation sees a file:\n  ${text}")
endif()
list(LENGTH files n)
message(STATUS "${n} files: no symbol is used upwards")
