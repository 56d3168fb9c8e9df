// SPDX-License-Identifier: MIT
#include "core/wire/utf8.h"

namespace posewire::wire {
namespace {

/// What may follow a lead byte: how many bytes, and the range of the first of them (RFC 3629 section 4).
struct Sequence {
    std::size_t following;
    unsigned char low;
    unsigned char high;
};

Sequence sequenceOf(unsigned char lead) {
    if (lead < 0xc2 || lead > 0xf4) {
        return {0, 1, 0};
    }
    if (lead < 0xe0) {
        return {1, 0x80, 0xbf};
    }
    if (lead < 0xf0) {
        return {2, static_cast<unsigned char>(lead == 0xe0 ? 0xa0 : 0x80),
                static_cast<unsigned char>(lead == 0xed ? 0x9f : 0xbf)};
    }
    return {3, static_cast<unsigned char>(lead == 0xf0 ? 0x90 : 0x80),
            static_cast<unsigned char>(lead == 0xf4 ? 0x8f : 0xbf)};
}

} // namespace

std::size_t firstInvalidUtf8(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        const auto lead = static_cast<unsigned char>(text[i]);
        if (lead < 0x80) {
            ++i;
            continue;
        }
        const Sequence sequence = sequenceOf(lead);
        if (sequence.following == 0 || text.size() - i <= sequence.following) {
            return i;
        }
        const auto second = static_cast<unsigned char>(text[i + 1]);
        if (second < sequence.low || second > sequence.high) {
            return i;
        }
        for (std::size_t k = 2; k <= sequence.following; ++k) {
            if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) {
                return i;
            }
        }
        i += sequence.following + 1;
    }
    return text.size();
}

} // namespace posewire::wire
