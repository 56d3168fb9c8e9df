# SPDX-License-Identifier: GPL-3.0-or-later
# Each build is named after its commit, when it is built. A tag vVERSION is a release: "0.2.0", the VERSION of project(). Any other
# commit is "0.2.0~dev.N+gHASH", N commits after the last release, with ".dirty" if tracked files differ from it. Without git the
# name comes from .git_archival.txt, which `git archive` fills in; else it is "0.2.0~dev", or "0.2.0" if CHANGELOG.md has that release.
#
# The target `version` writes into POSEWIRE_VERSION_FOLDER: version.txt (the name; the commit's time in seconds of Unix) and
# version.cpp, each only if it changes.
set(POSEWIRE_VERSION_FOLDER "${PROJECT_BINARY_DIR}/version")
set(POSEWIRE_VERSION_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/name_version.cmake")
set(POSEWIRE_FILL_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/fill_version.cmake")

add_custom_target(version
  COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DNEXT=${PROJECT_VERSION}" "-DINTO=${POSEWIRE_VERSION_FOLDER}"
    -P "${POSEWIRE_VERSION_SCRIPT}"
  BYPRODUCTS "${POSEWIRE_VERSION_FOLDER}/version.txt" "${POSEWIRE_VERSION_FOLDER}/version.cpp"
  COMMENT "Naming the version"
  VERBATIM)

# posewire_fill(FROM TO): puts @POSEWIRE_VERSION@, its dates and the list of releases into a text, again if they change.
function(posewire_fill from to)
  add_custom_command(OUTPUT "${to}"
    COMMAND "${CMAKE_COMMAND}" "-DSOURCE=${PROJECT_SOURCE_DIR}" "-DVERSION=${POSEWIRE_VERSION_FOLDER}/version.txt" "-DFROM=${from}"
      "-DTO=${to}" -P "${POSEWIRE_FILL_SCRIPT}"
    DEPENDS version "${POSEWIRE_VERSION_FOLDER}/version.txt" "${from}" "${POSEWIRE_FILL_SCRIPT}" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
    VERBATIM)
endfunction()
