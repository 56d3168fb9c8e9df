// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/raw_file.h"

namespace posewire::log {

/// Reads pcap (microseconds or nanoseconds, either byte order) or pcapng, recognized by the first four bytes,
/// and visits the datagrams that core/log/reassembly.h finds in it. The offset of a record is that of its
/// first byte in the file. A file that is cut off is read up to its last whole packet. What PcapngWriter has
/// written comes back as it was.
tl::expected<void, FileError> readCaptureFile(ByteSource& source, const FileVisitor& visit);

} // namespace posewire::log
