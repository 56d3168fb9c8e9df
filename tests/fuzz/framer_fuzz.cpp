// SPDX-License-Identifier: MIT
#include "core/log/tcp_framer.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <vector>

// Whatever the bytes: every byte comes out once and in order, and slicing makes no difference.
namespace {

using posewire::log::TcpFramer;

struct Cut {
    std::uint64_t offset;
    std::size_t size;
    TcpFramer::Kind kind;
    friend bool operator==(const Cut&, const Cut&) = default;
};

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

std::vector<Cut> cut(std::span<const std::byte> stream, std::size_t slice) {
    std::vector<Cut> cuts;
    std::uint64_t next = 0;
    const TcpFramer::Visitor visit = [&](const TcpFramer::Piece& piece) {
        require(piece.offset == next && !piece.bytes.empty() &&
                piece.offset + piece.bytes.size() <= stream.size());
        require(std::memcmp(piece.bytes.data(), stream.data() + piece.offset, piece.bytes.size()) == 0);
        next += piece.bytes.size();
        cuts.push_back({piece.offset, piece.bytes.size(), piece.kind});
    };
    TcpFramer framer;
    for (std::size_t at = 0; at < stream.size(); at += slice) {
        framer.push(stream.subspan(at, std::min(slice, stream.size() - at)), visit);
        require(framer.kept() <= TcpFramer::kMostKept);
    }
    framer.finish(visit);
    require(next == stream.size());
    return cuts;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) {
        return 0;
    }
    const std::size_t slice = 1U + data[0];
    const auto stream = std::as_bytes(std::span(data + 1, size - 1));
    require(cut(stream, stream.size()) == cut(stream, slice));
    return 0;
}
