// SPDX-License-Identifier: MIT
#include "core/wire/field_tree.h"
#include "core/wire/header.h"

#include <algorithm>
#include <cstdlib>

// Whatever the bytes: faults and notices lie inside, the field tree agrees with the decoder and stands on
// every byte once, and what was read is written to the bytes it was read from.
namespace {

using namespace posewire::wire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

bool hasBytesBehind(const Datagram& datagram) {
    return std::any_of(datagram.notices.begin(), datagram.notices.end(), [](const Notice& notice) {
        return notice.code == NoticeCode::TrailingBytes || notice.code == NoticeCode::SizeDisagrees;
    });
}

void checkWriting(Bytes bytes, const Datagram& datagram) {
    const auto encoded = encode(datagram);
    if (bytes.size() > kMaxDatagramSize) {
        return;
    }
    require(encoded.has_value());
    require(encoded->size() <= bytes.size() && std::equal(encoded->begin(), encoded->end(), bytes.begin()));
    require(hasBytesBehind(datagram) || encoded->size() == bytes.size());
}

void checkTree(Bytes bytes, const FieldTree& tree) {
    std::vector<bool> isParent(tree.nodes.size(), false);
    for (const FieldNode& node : tree.nodes) {
        require(node.offset <= bytes.size() && node.length <= bytes.size() - node.offset);
        if (node.parent >= 0) {
            isParent[static_cast<std::size_t>(node.parent)] = true;
        }
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const bool isLeaf = !isParent[i] && tree.nodes[i].length != 0;
        require(!isLeaf || tree.nodes[i].offset == next);
        next += isLeaf ? tree.nodes[i].length : 0;
    }
    require(tree.fault || next == bytes.size());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Bytes bytes = std::as_bytes(std::span(data, size));
    const FieldTree tree = fieldTree(bytes);
    const auto datagram = decode(bytes);
    require(datagram.has_value() == !tree.fault.has_value());
    checkTree(bytes, tree);
    if (datagram) {
        require(tree.notices == datagram->notices);
        for (const Notice& notice : datagram->notices) {
            require(notice.offset <= size);
        }
        checkWriting(bytes, *datagram);
    } else {
        require(datagram.error() == *tree.fault && datagram.error().offset <= size);
    }
    for (const bool isAtEnd : {false, true}) {
        const Extent extent = datagramExtent(bytes, isAtEnd);
        require(extent.size <= kMaxDatagramSize);
        require(!isAtEnd || extent.state != Extent::State::NeedMore);
    }
    return 0;
}
