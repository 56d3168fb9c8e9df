// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/raw_file.h"

namespace posewire::log {

/// Reads pcap (microseconds or nanoseconds, either byte order) or pcapng, told by the first four bytes, and
/// visits what was sent over UDP and begins with "MXTP". The offset of a record is that of the UDP payload in
/// the file. IP fragments are not put together: of a datagram that was sent in several, the first part is
/// visited and will be found to be cut off. A file that is cut off is read up to its last whole packet.
tl::expected<void, FileError> readCaptureFile(ByteSource& source, const FileVisitor& visit);

} // namespace posewire::log
