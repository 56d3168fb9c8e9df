# SPDX-License-Identifier: GPL-3.0-or-later
# How every target of the project is made: one dialect, one set of warnings, one place for sanitizers.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE RelWithDebInfo)
endif()

# ccache takes a unit with a precompiled header only where it may trust the header's own stamp.
find_program(POSEWIRE_CCACHE ccache)
if(POSEWIRE_CCACHE)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
    CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime "${POSEWIRE_CCACHE}")
endif()

if(WIN32)
  add_compile_definitions(_WIN32_WINNT=0x0A00 WIN32_LEAN_AND_MEAN NOMINMAX) # Windows 10
endif()
if(MSVC)
  add_compile_options(/W4 /utf-8 /permissive-)
else()
  add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds) # GCC 12 warns of its own std::string (bug 105651)
endif()
if(NOT MSVC)
  add_compile_options(-pthread) # one setting for all: a precompiled header is only good for units compiled like it
endif()
if(POSEWIRE_WERROR)
  set(CMAKE_COMPILE_WARNING_AS_ERROR ON)
endif()
if(POSEWIRE_SANITIZER OR POSEWIRE_FUZZ)
  add_compile_options(-O1 -g1) # a finding needs names and lines, and units compile in half the time
endif()
# What only tests say is run once: compiling it well takes longer than running it.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  set(test_options -O1)
endif()
# What is shipped reads whatever a network holds: a write past a buffer ends the program instead of taking it over.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND CMAKE_SYSTEM_NAME STREQUAL "Linux" AND NOT POSEWIRE_SANITIZER)
  add_compile_options(-fstack-protector-strong)
  add_compile_definitions(_FORTIFY_SOURCE=2)
  add_link_options(-Wl,-z,relro,-z,now)
endif()
if(POSEWIRE_SANITIZER STREQUAL "address")
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(POSEWIRE_SANITIZER STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
endif()
# libFuzzer follows the branches of what it tests. Test programs have nothing to be followed, and compile a tenth faster.
if(POSEWIRE_FUZZ)
  set(library_options -fsanitize=fuzzer-no-link)
endif()

# Where everything is compiled anew, headers cost more than code: several sources of a target make one unit then. Who
# works on a part compiles its sources one by one. Types of an unnamed namespace are not those of another unit.
if(POSEWIRE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

# Units of Windows stay on their own, for windows.h defines words such as near and interface.
function(posewire_unite target)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "(_windows|wgl_context)\\.cpp$")
  set_source_files_properties(${sources} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${POSEWIRE_UNITY} UNITY_BUILD_BATCH_SIZE 16)
endfunction()

# posewire_precompile(kind HEADERS … [LIBRARIES …]): headers of others that most units of a kind include, compiled once.
# Targets name their kind as PRECOMPILED; their units still include what they use.
function(posewire_precompile kind)
  cmake_parse_arguments(ARG "" "" "HEADERS;LIBRARIES" ${ARGN})
  set(unit "${CMAKE_BINARY_DIR}/precompiled_${kind}.cpp")
  file(CONFIGURE OUTPUT "${unit}" CONTENT "int main() {}\n")
  if(kind MATCHES "test$") # executables are compiled with other options than libraries
    add_executable(precompiled_${kind} EXCLUDE_FROM_ALL "${unit}")
    target_compile_options(precompiled_${kind} PRIVATE ${test_options})
  else()
    add_library(precompiled_${kind} STATIC EXCLUDE_FROM_ALL "${unit}")
    target_compile_options(precompiled_${kind} PRIVATE ${library_options})
  endif()
  set_target_properties(precompiled_${kind} PROPERTIES AUTOMOC OFF)
  target_link_libraries(precompiled_${kind} PRIVATE ${ARG_LIBRARIES})
  target_precompile_headers(precompiled_${kind} PRIVATE ${ARG_HEADERS})
endfunction()

function(posewire_use_precompiled target kind)
  if(POSEWIRE_PRECOMPILED AND kind AND NOT kind STREQUAL "none")
    target_precompile_headers(${target} REUSE_FROM precompiled_${kind})
    target_compile_options(${target} PRIVATE -Winvalid-pch)
  endif()
endfunction()

# posewire_library(name SOURCES … [PUBLIC …] [PRIVATE …] [PRECOMPILED kind]): a static library, alias posewire::name,
# with includes written from the repository root ("core/wire/header.h").
function(posewire_library name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  string(REPLACE "_" "::" alias "${name}")
  add_library(posewire::${alias} ALIAS ${name})
  target_compile_options(${name} PRIVATE ${library_options})
  target_include_directories(${name} PUBLIC "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  posewire_unite(${name})
  posewire_use_precompiled(${name} "${ARG_PRECOMPILED}")
endfunction()

# posewire_test(name SOURCES … LIBRARIES … [LABELS …] [ENVIRONMENT …] [PRECOMPILED kind]): a GoogleTest program.
# Each case is a ctest case; with POSEWIRE_UNITY each program is one.
# LABELS is "bytes" for what handles input from outside, "threads" for what runs several threads, "bytes-threads" for both:
# packaging/test builds these again with sanitizers, as the targets byte_tests and thread_tests.
function(posewire_test name)
  cmake_parse_arguments(ARG "" "PRECOMPILED" "SOURCES;LIBRARIES;LABELS;ENVIRONMENT" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_compile_options(${name} PRIVATE ${test_options})
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE ${ARG_LIBRARIES} posewire::test::support GTest::gmock GTest::gtest_main)
  posewire_unite(${name})
  if(NOT ARG_PRECOMPILED)
    set(ARG_PRECOMPILED test)
  endif()
  posewire_use_precompiled(${name} ${ARG_PRECOMPILED})
  set(properties TIMEOUT 300)
  if(ARG_LABELS)
    list(APPEND properties LABELS "${ARG_LABELS}")
  endif()
  if(ARG_ENVIRONMENT)
    list(APPEND properties ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
  foreach(kind bytes threads)
    string(REGEX REPLACE "s$" "_tests" group ${kind})
    if("${ARG_LABELS}" MATCHES ${kind})
      add_dependencies(${group} ${name})
    endif()
  endforeach()
  if(NOT POSEWIRE_SANITIZED_TESTS AND "${ARG_LABELS}" MATCHES "bytes|threads")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    return()
  endif()
  if(POSEWIRE_UNITY) # everything is run: starting a program costs more than most cases
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES ${properties} TIMEOUT 900)
  else()
    gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST PROPERTIES ${properties})
  endif()
endfunction()
include(GoogleTest)
