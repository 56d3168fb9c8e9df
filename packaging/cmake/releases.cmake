# SPDX-License-Identifier: GPL-3.0-or-later
# Sets releases, "VERSION DATE" for each that CHANGELOG.md in the tree SOURCE names, newest first, and released, the newest version.
file(STRINGS "${SOURCE}/CHANGELOG.md" headings REGEX "^## \\[[0-9]")
set(releases "")
foreach(heading IN LISTS headings)
  if(NOT heading MATCHES "^## \\[([0-9.]+)\\] - ([0-9-]+)$")
    message(FATAL_ERROR "CHANGELOG.md: \"${heading}\" is not of the form \"## [1.2.3] - 2026-01-31\"")
  endif()
  list(APPEND releases "${CMAKE_MATCH_1} ${CMAKE_MATCH_2}")
endforeach()
string(REGEX MATCH "^[0-9.]+" released "${releases}")
