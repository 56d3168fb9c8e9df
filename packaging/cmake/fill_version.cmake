# SPDX-License-Identifier: GPL-3.0-or-later
# Writes TO from FROM, with POSEWIRE_VERSION, POSEWIRE_DATE (its commit's, "2026-01-31"), POSEWIRE_MAIL_DATE (RFC 5322) and
# POSEWIRE_RELEASES (elements of AppStream, newest first). VERSION is the file that name_version.cmake wrote.
cmake_minimum_required(VERSION 3.25)
include("${CMAKE_CURRENT_LIST_DIR}/releases.cmake")
file(STRINGS "${VERSION}" lines)
list(POP_FRONT lines POSEWIRE_VERSION epoch)
set(ENV{SOURCE_DATE_EPOCH} "${epoch}")
string(TIMESTAMP POSEWIRE_DATE "%Y-%m-%d" UTC)
string(TIMESTAMP POSEWIRE_MAIL_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)

set(elements "")
if(NOT POSEWIRE_VERSION STREQUAL released)
  list(APPEND elements "<release version=\"${POSEWIRE_VERSION}\" date=\"${POSEWIRE_DATE}\" type=\"development\"/>")
endif()
foreach(release IN LISTS releases)
  string(REGEX REPLACE "^(.*) (.*)$" "<release version=\"\\1\" date=\"\\2\"/>" element "${release}")
  list(APPEND elements "${element}")
endforeach()
list(JOIN elements "\n    " POSEWIRE_RELEASES)
configure_file("${FROM}" "${TO}" @ONLY)
