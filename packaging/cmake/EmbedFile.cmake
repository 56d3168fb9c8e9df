# SPDX-License-Identifier: GPL-3.0-or-later
# posewire_embed(target NAMESPACE posewire::render::shaders HEADER shader_files.h FILES a.vert b.frag …)
#
# Compiles the bytes of the files into the target. The header, found by #include "shader_files.h" inside the target only,
# declares one function a file, named after it in camelCase (`skinned_body.vert` becomes `skinnedBodyVert()`), that
# returns a std::string_view of the bytes; a zero byte follows them, so a text may be handed on as a C string.
# A changed file is embedded again by the next build.

if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  # The build calls this file again as a script, with INPUT, OUTPUT, NAMESPACE and FUNCTION set.
  # A compiler reads a string much faster than a list of numbers.
  file(READ "${INPUT}" hex HEX)
  string(REGEX REPLACE "(................................................................)" "\\1\n" lines "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" text "${lines}")
  string(REPLACE "\n" "\"\n\"" text "${text}")
  file(SIZE "${INPUT}" size)
  file(WRITE "${OUTPUT}"
    "#include <string_view>\n"
    "namespace ${NAMESPACE} {\n"
    "std::string_view ${FUNCTION}();\n"
    "std::string_view ${FUNCTION}() { return {\n\"${text}\",\n${size}}; }\n"
    "}\n")
  return()
endif()

set(POSEWIRE_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_FILE}")

function(posewire_embed target)
  cmake_parse_arguments(ARG "" "NAMESPACE;HEADER" "FILES" ${ARGN})
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/embedded")
  set(declarations "")
  foreach(file IN LISTS ARG_FILES)
    cmake_path(ABSOLUTE_PATH file NORMALIZE)
    get_filename_component(name "${file}" NAME)
    string(REGEX MATCHALL "[A-Za-z0-9]+" words "${name}")
    set(function "")
    foreach(word IN LISTS words)
      if(function STREQUAL "")
        set(function "${word}")
      else()
        string(SUBSTRING "${word}" 0 1 first)
        string(SUBSTRING "${word}" 1 -1 rest)
        string(TOUPPER "${first}" first)
        string(APPEND function "${first}${rest}")
      endif()
    endforeach()
    set(source "${folder}/${target}_${name}.cpp")
    add_custom_command(OUTPUT "${source}"
      COMMAND "${CMAKE_COMMAND}" "-DINPUT=${file}" "-DOUTPUT=${source}" "-DNAMESPACE=${ARG_NAMESPACE}"
        "-DFUNCTION=${function}" -P "${POSEWIRE_EMBED_SCRIPT}"
      DEPENDS "${file}" "${POSEWIRE_EMBED_SCRIPT}"
      COMMENT "Embedding ${name}"
      VERBATIM)
    target_sources(${target} PRIVATE "${source}")
    string(APPEND declarations "std::string_view ${function}();\n")
  endforeach()
  file(CONFIGURE OUTPUT "${folder}/${ARG_HEADER}" @ONLY CONTENT
    "#pragma once\n#include <string_view>\nnamespace @ARG_NAMESPACE@ {\n@declarations@}\n")
  target_include_directories(${target} PRIVATE "${folder}")
  # Longer than every compiler has to take.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings>)
endfunction()
