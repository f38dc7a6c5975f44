# Compiler options shared by all rooms. `lahar_options` is linked by every target of ours.
option(LAHAR_NATIVE "Optimise for the processor of this machine (-march=native)" ON)
option(LAHAR_WERROR "Treat warnings of Lahar's own sources as errors" ON)
option(LAHAR_BUILD_TESTS "Build the test suite" ${PROJECT_IS_TOP_LEVEL})
option(LAHAR_PRECOMPILE "Read the headers of libraries once per group of targets: a shorter build" ON)
set(LAHAR_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined or thread")

include(GNUInstallDirs)
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)

# Without a build type the compiler would not optimise at all; presets without one say -O themselves.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )-O" AND NOT CMAKE_CONFIGURATION_TYPES)
  message(STATUS "No build type given: taking Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  # What it has to overlook to serve translation units with precompiled headers (its manual, "Precompiled headers").
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

if(LAHAR_SANITIZE)
  # Undefined behaviour ends the program: else it would only be printed.
  add_compile_options(-fsanitize=${LAHAR_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${LAHAR_SANITIZE})
endif()

add_library(lahar_options INTERFACE)
add_library(Lahar::options ALIAS lahar_options)
# Of users, too: vectors of packs and of Eigen have the same layout in every translation unit, or inline functions clash.
if(LAHAR_NATIVE)
  target_compile_options(lahar_options INTERFACE -march=native)
endif()
if(PROJECT_IS_TOP_LEVEL)  # another project that takes Lahar in has warnings of its own
  target_compile_options(lahar_options INTERFACE
    $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wnon-virtual-dtor;-Wno-psabi>
    $<BUILD_INTERFACE:$<$<BOOL:${LAHAR_WERROR}>:-Werror>>
    # GCC 12 warns of uninitialized registers inside its own AVX-512 header.
    $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>>)
endif()
target_compile_features(lahar_options INTERFACE cxx_std_20)
set_target_properties(lahar_options PROPERTIES EXPORT_NAME options)

# lahar_precompile(TARGET [FROM OTHER] [HEADER ...]): the headers of libraries that most of a target's sources include.
# FROM takes those of another target, which must be compiled with the same options.
function(lahar_precompile target)
  cmake_parse_arguments(ARG "" "FROM" "" ${ARGN})
  if(NOT LAHAR_PRECOMPILE)
    return()
  endif()
  if(ARG_FROM)
    target_precompile_headers(${target} REUSE_FROM ${ARG_FROM})
  else()
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <filesystem> <functional> <map> <numbers>
                              <optional> <random> <string> <vector> <Eigen/Dense> <tbb/blocked_range.h>
                              <tbb/global_control.h> <tbb/parallel_for.h> ${ARG_UNPARSED_ARGUMENTS})
  endif()
endfunction()

# lahar_library(NAME SOURCES ... DEPENDS ...): a room as a static library Lahar::NAME.
function(lahar_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  add_library(lahar_${name} STATIC ${ARG_SOURCES})
  add_library(Lahar::${name} ALIAS lahar_${name})
  set_target_properties(lahar_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_include_directories(lahar_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/lahar>)
  target_link_libraries(lahar_${name} PUBLIC Lahar::options ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS})
endfunction()
