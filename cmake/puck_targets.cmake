# What every target of the project shares, and the functions that declare targets.

find_program(PUCK_CCACHE ccache)
if(PUCK_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${PUCK_CCACHE})
endif()

set(CMAKE_CXX_FLAGS_RELEASE "-O1 -DNDEBUG")
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer")
# Code that does the work event by event. Clang inlines more than usual here: with a sanitizer's checks
# even an array's operator[] is too long for it otherwise.
set(puck_fast_options $<$<CONFIG:Release>:-O3> $<$<CONFIG:Sanitize>:-O2>
                      "$<$<CONFIG:Sanitize>:SHELL:-mllvm -inline-threshold=600>")

find_package(hwy REQUIRED)
if(NOT PUCK_CORE_ONLY)
  find_package(Threads REQUIRED)
endif()

add_library(puck_options INTERFACE)
# Every field has its initialiser in the struct, so a designated list may leave fields out.
target_compile_options(puck_options INTERFACE -Wall -Wextra -Wpedantic -Werror
                                              -Wno-missing-field-initializers)
# In a unity build a local of one source would shadow a constant of another one.
target_compile_options(puck_options INTERFACE
  $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>)
# False alarms of GCC 12's flow analysis in the standard library, below -O2 and in unity builds.
target_compile_options(puck_options INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized;\
-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread;-Wno-restrict>")
target_include_directories(puck_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(puck_options INTERFACE PUCK_VERSION="${PROJECT_VERSION}")
if(PUCK_SANITIZE)
  target_compile_options(puck_options INTERFACE -fsanitize=${PUCK_SANITIZE}
                                                -fno-sanitize-recover=all)
  target_link_options(puck_options INTERFACE -fsanitize=${PUCK_SANITIZE})
  # The library checks indices, which no sanitizer does within a vector's capacity.
  target_compile_definitions(puck_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# puck_compile_alone(<source>...): sources of the current folder that stay out of unity builds.
function(puck_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# puck_compile_plainly(<source>...): … and that the optimiser works on for longer than they ever run.
function(puck_compile_plainly)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0)
endfunction()

# puck_emulate_vectors(<target>): where a processor has none of Highway's vectors (also x86 without SSSE3), they are
# emulated. Before GCC 12.3 Highway would use single lanes instead, because GCC miscompiles the upper halves of emulated
# products (bug 106322): no MulHigh in such a target.
function(puck_emulate_vectors target)
  target_compile_definitions(${target} PRIVATE HWY_BROKEN_EMU128=0)
endfunction()

# puck_library(<name> [FAST] [LINKS <library>...] [PRIVATE_LINKS <library>...])
# A static library of all the sources in the current folder. FAST: it is optimised for speed.
function(puck_library name)
  cmake_parse_arguments(arg "FAST" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(NOT sources)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE puck_options ${arg_LINKS} ${arg_PRIVATE_LINKS})
    return()
  endif()
  add_library(${name} STATIC ${sources})
  if(arg_FAST)
    target_compile_options(${name} PRIVATE ${puck_fast_options})
  endif()
  target_link_libraries(${name} PUBLIC puck_options ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS})
endfunction()

# All services and tools; the tests by label, with the programs that they run.
foreach(group puck_programs puck_unit_tests puck_system_tests puck_deep_tests puck_thread_tests)
  add_custom_target(${group})
endforeach()

# puck_program(<name> [LINKS <library>...])
# A program from main.cpp in the current folder; it lands in the build folder's bin/. Outside tests/
# it belongs to puck_programs.
function(puck_program name)
  cmake_parse_arguments(arg "" "" "LINKS" ${ARGN})
  add_executable(${name} main.cpp)
  puck_compile_plainly(main.cpp)
  target_link_libraries(${name} PRIVATE puck_options ${arg_LINKS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests/")
    add_dependencies(puck_programs ${name})
  endif()
endfunction()

# puck_test(<name> [DEEP] [THREADS] [LABEL unit|system|deep] [LINKS <library>...]
#           [PROGRAMS <target>...])
# A doctest program of all the sources in the current folder; label unit unless another is given.
# DEEP: its test suite "deep" is a test of its own, <name>_deep. THREADS: ThreadSanitizer tests it, too.
# PROGRAMS: the test runs them.
function(puck_test name)
  cmake_parse_arguments(arg "DEEP;THREADS" "LABEL" "LINKS;PROGRAMS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE puck_options puck_test_main ${arg_LINKS})
  if(arg_PROGRAMS)
    add_dependencies(${name} ${arg_PROGRAMS})
  endif()
  if(NOT arg_LABEL)
    set(arg_LABEL unit)
  endif()
  add_dependencies(puck_${arg_LABEL}_tests ${name})
  add_test(NAME ${name} COMMAND ${name} --test-suite-exclude=deep)
  set_tests_properties(${name} PROPERTIES LABELS ${arg_LABEL})
  if(arg_THREADS)
    add_dependencies(puck_thread_tests ${name})
    set_tests_properties(${name} PROPERTIES LABELS "${arg_LABEL};threads")
  endif()
  set(tests ${name})
  if(arg_DEEP)
    add_dependencies(puck_deep_tests ${name})
    add_test(NAME ${name}_deep COMMAND ${name} --test-suite=deep)
    set_tests_properties(${name}_deep PROPERTIES LABELS deep)
    list(APPEND tests ${name}_deep)
  endif()
  set_tests_properties(${tests} PROPERTIES TIMEOUT 1200
    ENVIRONMENT "PUCK_SOURCE_DIR=${PROJECT_SOURCE_DIR};PUCK_BIN_DIR=${CMAKE_BINARY_DIR}/bin;\
TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/tsan_suppressions.txt")
endfunction()
