# SPDX-License-Identifier: GPL-3.0-or-later
# Cross-compiles for 64-bit Windows with Debian's mingw-w64. Libraries are found in POSEWIRE_WINDOWS_LIBRARIES, which
# packaging/windows-libraries fills, and nowhere else: the headers of this computer's own libraries are of another system.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES POSEWIRE_WINDOWS_LIBRARIES)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
if(POSEWIRE_WINDOWS_LIBRARIES)
  list(PREPEND CMAKE_FIND_ROOT_PATH "${POSEWIRE_WINDOWS_LIBRARIES}")
  list(PREPEND CMAKE_PREFIX_PATH "${POSEWIRE_WINDOWS_LIBRARIES}")
endif()
set(ENV{PKG_CONFIG_LIBDIR} "${POSEWIRE_WINDOWS_LIBRARIES}/lib/pkgconfig")
set(ZLIB_LIBRARY /usr/x86_64-w64-mingw32/lib/libz.a CACHE FILEPATH "Static: CMake takes the import library of a DLL first")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# Nothing but what Windows itself has is loaded at run time. Threads are those of winpthreads.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")

set(CMAKE_CROSSCOMPILING_EMULATOR "${CMAKE_CURRENT_LIST_DIR}/../wine")
