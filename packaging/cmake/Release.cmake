# SPDX-License-Identifier: GPL-3.0-or-later
# POSEWIRE_RELEASE_DATE: when the version of this tree was released, as CHANGELOG.md says.
file(STRINGS "${PROJECT_SOURCE_DIR}/CHANGELOG.md" releases REGEX "^## \\[[0-9]")
list(GET releases 0 newest)
if(NOT newest MATCHES "^## \\[([0-9.]+)\\] - ([0-9-]+)$")
  message(FATAL_ERROR "CHANGELOG.md: \"${newest}\" is not of the form \"## [1.2.3] - 2026-01-31\"")
endif()
set(POSEWIRE_RELEASE_DATE "${CMAKE_MATCH_2}")
if(NOT CMAKE_MATCH_1 STREQUAL PROJECT_VERSION)
  message(FATAL_ERROR "CHANGELOG.md: its newest version is ${CMAKE_MATCH_1}, that of the project is ${PROJECT_VERSION}")
endif()
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/CHANGELOG.md")
