# What every target of the project shares, and the few functions that declare targets.

find_program(PUCK_CCACHE ccache)
if(PUCK_CCACHE)
  # Goes by the files that the compiler says it read (-MD). Otherwise ccache preprocesses each file to
  # look it up, which takes as long as compiling many a small one, and with GCC does not see that a
  # precompiled header is another one where only a macro in it has changed.
  set(puck_ccache_settings CCACHE_DEPEND=1)
  if(PUCK_PRECOMPILE)
    # Without the first, ccache keeps nothing that was compiled with a precompiled header; for the
    # second see sum_precompiled.sh.
    list(APPEND puck_ccache_settings CCACHE_SLOPPINESS=pch_defines,time_macros CCACHE_PCH_EXTSUM=1)
  endif()
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env ${puck_ccache_settings} ${PUCK_CCACHE})
endif()

# Sanitizer builds: enough symbols to read a report, and enough optimisation for what keeps time. More
# of it have only libraries that COMPUTE (see puck_library): it takes longer than most tests run.
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer")
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# SIMD for the core, whose only dependency it is.
find_package(hwy REQUIRED)
if(NOT PUCK_CORE_ONLY)
  find_package(Threads REQUIRED)
endif()

# A warning that only GCC knows.
set(puck_no_flow_analysis $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)

add_library(puck_options INTERFACE)
# Every field has its initialiser in the struct, so what a designated list leaves out is defined.
target_compile_options(puck_options INTERFACE -Wall -Wextra -Wpedantic -Werror
                                              -Wno-missing-field-initializers)
# Of sources that are compiled as one, a local of one would shadow another one's constant. That in
# tests, too, nothing is shadowed is for preset dev to see, which compiles each source by itself.
target_compile_options(puck_options INTERFACE
  $<IF:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>,$<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>,-Wshadow>)
target_include_directories(puck_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_definitions(puck_options INTERFACE PUCK_VERSION="${PROJECT_VERSION}")
if(PUCK_SANITIZE)
  target_compile_options(puck_options INTERFACE -fsanitize=${PUCK_SANITIZE}
                                                -fno-sanitize-recover=all)
  target_link_options(puck_options INTERFACE -fsanitize=${PUCK_SANITIZE})
  # The library's own checks of indices, which no sanitizer makes within a vector's capacity.
  target_compile_definitions(puck_options INTERFACE _GLIBCXX_ASSERTIONS)
endif()

# What runs once or is a test is not worth the minutes that optimising it takes. With little
# optimisation GCC's flow analysis loses its way.
set(puck_quick_options $<$<CONFIG:Release>:-O1> ${puck_no_flow_analysis})

# Half the time of a build goes into reading the standard library again for each file. With
# PUCK_PRECOMPILE it is read once for all targets, and once more for those compiled with other
# options.
if(PUCK_PRECOMPILE)
  set(puck_common_headers
    <algorithm> <array> <atomic> <bit> <charconv> <chrono> <cmath> <condition_variable> <cstdint>
    <cstdio> <cstdlib> <cstring> <exception> <filesystem> <fstream> <functional> <limits> <map>
    <memory> <mutex> <numbers> <optional> <random> <set> <span> <sstream> <stdexcept> <stop_token>
    <string> <string_view> <system_error> <thread> <utility> <variant> <vector>)
  # Precompiled headers belong to a target, and a target has a source.
  file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
  # With its time in it, no two are the same to ccache.
  target_compile_options(puck_options INTERFACE
    "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
  # puck_precompiled_headers(<name> <compile options> <more headers>)
  function(puck_precompiled_headers name options headers)
    add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
    target_compile_options(${name} PRIVATE ${options})
    target_link_libraries(${name} PRIVATE puck_options)
    target_precompile_headers(${name} PRIVATE ${puck_common_headers} ${headers})
    if(PUCK_CCACHE)
      set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER
        "${PROJECT_SOURCE_DIR}/cmake/sum_precompiled.sh;${CMAKE_CXX_COMPILER_LAUNCHER}")
    endif()
  endfunction()
  puck_precompiled_headers(puck_precompiled "" "")
  if(NOT PUCK_CORE_ONLY)
    puck_precompiled_headers(puck_precompiled_tests "${puck_quick_options}" <doctest/doctest.h>)
    find_package(doctest REQUIRED)
    target_link_libraries(puck_precompiled_tests PRIVATE doctest::doctest)
  endif()
  if(PUCK_SANITIZE)
    puck_precompiled_headers(puck_precompiled_computing -O2 "")
  endif()
endif()

# puck_precompile(<target> <headers>): compiles it with those of one of the targets above.
function(puck_precompile name headers)
  if(PUCK_PRECOMPILE)
    target_precompile_headers(${name} REUSE_FROM ${headers})
  endif()
endfunction()

# puck_unite(<target>): for tests, and for libraries that are sanitized. With PUCK_UNITY its sources
# are compiled eight at a time, as one that includes them, so that headers are read and templates
# made once for all eight. Within a target no name may then stand for two things, not even in
# anonymous namespaces. Where the compiler speaks of a redefinition, or of what is ambiguous, in two
# sources: what both need belongs in a header of their folder, else one of them says more closely
# what it means. Which eight go together changes with each new source;
# -DCMAKE_UNITY_BUILD_BATCH_SIZE=0 takes all of a target's, to find all such names.
function(puck_unite name)
  if(PUCK_UNITY)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON)
    # In so much at once GCC 12 sees strings copied beyond their ends, which they are not.
    target_compile_options(${name} PRIVATE
      "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overflow;-Wno-stringop-overread>")
  endif()
endfunction()

# puck_compile_alone(<source>...): sources of the current folder that no other may be compiled with.
function(puck_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# puck_compile_quickly(<source>...): sources of the current folder that need not be fast.
# Sanitizer builds, which are Clang's, leave them as they are.
function(puck_compile_quickly)
  if(NOT PUCK_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${puck_quick_options}")
  endif()
endfunction()

# puck_compile_without_precompiled(<source>...): of sources of the current folder. With precompiled
# headers GCC 12 says of a std::string in them that it is copied beyond its end, which it is not.
function(puck_compile_without_precompiled)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# puck_compile_plainly(<source>...): sources of the current folder with so much code of headers that
# Clang takes longer to optimise it instrumented than it runs. Sanitizer builds leave it as it is.
function(puck_compile_plainly)
  if(PUCK_SANITIZE)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# puck_compile_plainly_as_one(<library> <source>...): the same for several sources of a library that
# make the same templates. Of the library's properties they have but what it links.
function(puck_compile_plainly_as_one name)
  if(NOT PUCK_SANITIZE)
    return()
  endif()
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE plain)
  get_target_property(others ${name} SOURCES)
  list(REMOVE_ITEM others ${plain})
  add_library(${name}_plain OBJECT ${plain})
  puck_unite(${name}_plain)
  target_compile_options(${name}_plain PRIVATE -O0)
  target_link_libraries(${name}_plain PRIVATE $<TARGET_PROPERTY:${name},LINK_LIBRARIES>)
  set_property(TARGET ${name} PROPERTY SOURCES ${others} $<TARGET_OBJECTS:${name}_plain>)
endfunction()

# puck_library(<name> [COMPUTES] [LINKS <library>...] [PRIVATE_LINKS <library>...])
# A static library of all the sources in the current folder.
# COMPUTES: tests spend their time in it, so sanitizer builds optimise it with -O2 and inline more
# than usual: with its checks even an array's operator[] is too long for Clang otherwise.
function(puck_library name)
  cmake_parse_arguments(arg "COMPUTES" "" "LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/main\\.cpp$")
  if(sources)
    add_library(${name} STATIC ${sources})
    # What is fast when compiled file by file stays as it is.
    if(PUCK_SANITIZE)
      puck_unite(${name})
    endif()
    if(arg_COMPUTES AND PUCK_SANITIZE)
      target_compile_options(${name} PRIVATE
        -O2 "$<$<CXX_COMPILER_ID:Clang>:SHELL:-mllvm -inline-threshold=600>")
      puck_precompile(${name} puck_precompiled_computing)
    else()
      puck_precompile(${name} puck_precompiled)
    endif()
    target_link_libraries(${name} PUBLIC puck_options ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS})
  else()
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE puck_options ${arg_LINKS} ${arg_PRIVATE_LINKS})
  endif()
endfunction()

# All services and tools, without the tests.
add_custom_target(puck_programs)

# puck_program(<name> [LINKS <library>...])
# A program from main.cpp in the current folder; it lands in the build folder's bin/.
function(puck_program name)
  cmake_parse_arguments(arg "" "" "LINKS" ${ARGN})
  add_executable(${name} main.cpp)
  puck_precompile(${name} puck_precompiled)
  puck_compile_quickly(main.cpp)
  puck_compile_plainly(main.cpp)
  target_link_libraries(${name} PRIVATE puck_options ${arg_LINKS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  add_dependencies(puck_programs ${name})
endfunction()

# The tests of single libraries and services, and those of them that run threads.
add_custom_target(puck_unit_tests)
add_custom_target(puck_thread_tests)

# puck_test(<name> [LONG] [THREADS [WITHOUT_THREADS <source>...]] [LINKS <library>...]
#           [LABELS <label>...])
# A doctest program of all the sources in the current folder; label unit unless others are given.
# LONG: it is begun before the others, so that no core waits for it in the end.
# THREADS: what it tests runs threads, so it is tested under ThreadSanitizer, too, but for the
# sources WITHOUT_THREADS, whose long single-threaded work would only be slow there.
function(puck_test name)
  cmake_parse_arguments(arg "LONG;THREADS" "" "LINKS;LABELS;WITHOUT_THREADS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    return()
  endif()
  set(left_out)
  if(PUCK_SANITIZE STREQUAL thread AND arg_WITHOUT_THREADS)
    list(TRANSFORM arg_WITHOUT_THREADS PREPEND "*/")
    list(JOIN arg_WITHOUT_THREADS "," patterns)
    set(left_out "--source-file-exclude=${patterns}")
  endif()
  add_executable(${name} ${sources})
  puck_precompile(${name} puck_precompiled_tests)
  puck_unite(${name})
  target_compile_options(${name} PRIVATE ${puck_quick_options})
  target_link_libraries(${name} PRIVATE puck_options puck_test_main ${arg_LINKS})
  add_test(NAME ${name} COMMAND ${name} ${left_out})
  if(arg_LONG)
    set_tests_properties(${name} PROPERTIES COST 100)
  endif()
  set(labels ${arg_LABELS})
  if(NOT labels)
    set(labels unit)
  endif()
  if(unit IN_LIST labels)
    add_dependencies(puck_unit_tests ${name})
  endif()
  if(arg_THREADS)
    list(APPEND labels threads)
    add_dependencies(puck_thread_tests ${name})
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${labels}" TIMEOUT 1200
    ENVIRONMENT "PUCK_SOURCE_DIR=${PROJECT_SOURCE_DIR};PUCK_BIN_DIR=${CMAKE_BINARY_DIR}/bin;\
TSAN_OPTIONS=suppressions=${PROJECT_SOURCE_DIR}/tests/support/tsan_suppressions.txt")
endfunction()
