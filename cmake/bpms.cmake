# One line a library, a tool, a test, a fuzz target.
option(BPMS_TESTS "build the tests" ON)
option(BPMS_BENCH "build the benchmarks" OFF)
option(BPMS_FUZZ "build the fuzz targets (clang)" OFF)
option(BPMS_WERROR "warnings are errors" ON)
set(BPMS_SANITIZE "" CACHE STRING "sanitizers, e.g. address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
find_program(BPMS_CCACHE ccache)
if(BPMS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER ${BPMS_CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${BPMS_CCACHE})
endif()
find_package(Threads REQUIRED)

add_library(bpms_flags INTERFACE)
target_include_directories(bpms_flags INTERFACE ${CMAKE_SOURCE_DIR})
# -Wno-restrict: GCC 12 warns falsely on std::string + (GCC bug 105651).
target_compile_options(bpms_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${BPMS_WERROR}>:-Werror>)
target_link_libraries(bpms_flags INTERFACE Threads::Threads)
if(BPMS_SANITIZE)
  # GCC's own <regex> draws this warning falsely once it is instrumented.
  target_compile_options(bpms_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_compile_options(bpms_flags INTERFACE -fsanitize=${BPMS_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(bpms_flags INTERFACE -fsanitize=${BPMS_SANITIZE})
endif()

# bpms_floors(core plant ...): enters the folders that exist (a stage with nothing in it has no folder).
function(bpms_floors)
  set_property(GLOBAL PROPERTY BPMS_FLOORS ${ARGN})
  foreach(floor ${ARGN})
    if(EXISTS ${CMAKE_SOURCE_DIR}/${floor}/CMakeLists.txt)
      add_subdirectory(${floor})
    endif()
  endforeach()
endfunction()

# bpms_library(plant SOURCES a.cpp ... LINK bpms::core PRIVATE_LINK fmt::fmt): the target bpms::plant.
function(bpms_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK;PRIVATE_LINK" ${ARGN})
  add_library(bpms_${name} STATIC ${ARG_SOURCES})
  add_library(bpms::${name} ALIAS bpms_${name})
  # Ours is warned about; what a package's headers do is not our business.
  target_link_libraries(bpms_${name} PUBLIC ${ARG_LINK} PRIVATE bpms_flags ${ARG_PRIVATE_LINK})
  target_include_directories(bpms_${name} PUBLIC ${CMAKE_SOURCE_DIR})
endfunction()

# bpms_tool(bpms SOURCES ... LINK ...): a program.
function(bpms_tool name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE bpms_flags ${ARG_LINK})
endfunction()

# bpms_test(core SOURCES ... LINK ... [SLOW] [LABELS physics]): one GoogleTest program a folder; label "fast" unless SLOW, and
# what LABELS adds.
function(bpms_test name)
  cmake_parse_arguments(ARG "SLOW" "" "SOURCES;LINK;LABELS" ${ARGN})
  find_package(GTest REQUIRED)
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE bpms_flags ${ARG_LINK} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(test_${name} PRIVATE BPMS_SOURCE_DIR="${CMAKE_SOURCE_DIR}" BPMS_BINARY_DIR="${CMAKE_BINARY_DIR}")
  include(GoogleTest)
  if(ARG_SLOW)
    set(label slow)
  else()
    set(label fast)
  endif()
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES LABELS ${label} TIMEOUT 600)
  if(ARG_LABELS)
    # A list of labels does not survive the discovery: it is set on what was discovered.
    set(labels_file ${CMAKE_CURRENT_BINARY_DIR}/test_${name}_labels.cmake)
    file(WRITE ${labels_file} "foreach(test IN LISTS test_${name}_TESTS)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${label};${ARG_LABELS}\")
endforeach()
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${labels_file})
  endif()
endfunction()

# bpms_fuzz(csv SOURCES ... LINK ...): a libFuzzer target with the seed corpus tests/fuzz/corpus/NAME.
function(bpms_fuzz name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(fuzz_${name} ${ARG_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE bpms_flags ${ARG_LINK})
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
endfunction()
