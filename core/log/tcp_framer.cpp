// SPDX-License-Identifier: MIT
#include "core/log/tcp_framer.h"

#include "core/wire/header.h"

#include <algorithm>
#include <cstring>

namespace posewire::log {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kMark = 6; ///< "MXTP" and two digits
/// With this many bytes every question about the datagram at their front can be answered.
constexpr std::size_t kEnough = wire::kMaxDatagramSize + kMark;
static_assert(kEnough <= TcpFramer::kMostKept && TcpFramer::kLongestSkip + kMark <= TcpFramer::kMostKept);

/// The place of the first mark at or after `from`. Without `isAtEnd` the bytes may end within it.
std::size_t findMark(Bytes bytes, std::size_t from, bool isAtEnd) {
    while (from < bytes.size()) {
        const void* found = std::memchr(bytes.data() + from, 'M', bytes.size() - from);
        if (found == nullptr) {
            break;
        }
        from = static_cast<std::size_t>(static_cast<const std::byte*>(found) - bytes.data());
        const Bytes here = bytes.subspan(from);
        const bool isCut = here.size() < kMark && !isAtEnd;
        const auto extent =
            wire::datagramExtent(here.first(std::min(here.size(), wire::kHeaderSize)), isAtEnd);
        if (wire::startsDatagram(here) || (isCut && extent.state != wire::Extent::State::Foreign)) {
            return from;
        }
        ++from;
    }
    return bytes.size();
}

} // namespace

/// What is being cut: bytes[begin …] is not given out yet, bytes[at …] is looked at; between them nothing is
/// a datagram.
struct TcpFramer::Window {
    Bytes bytes;
    bool isAtEnd;
    const Visitor& visit;
    std::size_t begin = 0;
    std::size_t at = 0;

    [[nodiscard]] Bytes rest() const { return bytes.subspan(at); }
    /// What decisions may depend on: never more than the same bytes would show in smaller slices.
    [[nodiscard]] Bytes view() const { return rest().first(std::min(rest().size(), kEnough)); }
    [[nodiscard]] bool endsInView() const { return isAtEnd && rest().size() <= kEnough; }
};

TcpFramer::TcpFramer() {
    m_kept.reserve(kMostKept);
}

void TcpFramer::push(Bytes bytes, const Visitor& visit) {
    while (!bytes.empty() && !m_kept.empty()) {
        const std::size_t taken = std::min(bytes.size(), kMostKept - m_kept.size());
        m_kept.insert(m_kept.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(taken));
        bytes = bytes.subspan(taken);
        if (m_kept.size() >= m_need) {
            const std::size_t used = parse(m_kept, false, visit);
            m_kept.erase(m_kept.begin(), m_kept.begin() + static_cast<std::ptrdiff_t>(used));
        }
    }
    if (!bytes.empty()) {
        const std::size_t used = parse(bytes, false, visit);
        m_kept.assign(bytes.begin() + static_cast<std::ptrdiff_t>(used), bytes.end());
    }
}

void TcpFramer::finish(const Visitor& visit) {
    parse(m_kept, true, visit);
    m_kept.clear();
    m_ruledOut = 0;
    m_need = 0;
    m_offset = 0;
    m_isInStep = true;
}

std::size_t TcpFramer::parse(Bytes bytes, bool isAtEnd, const Visitor& visit) {
    Window window{bytes, isAtEnd, visit, 0, m_ruledOut};
    m_need = 0;
    while (window.at < bytes.size() && step(window)) {
    }
    if (isAtEnd) {
        pass(window, bytes.size(), Kind::Skipped);
    }
    m_ruledOut = window.at - window.begin;
    return window.begin;
}

/// Decides about one place. False if that takes more bytes.
bool TcpFramer::step(Window& window) {
    using State = wire::Extent::State;
    const wire::Extent extent = wire::datagramExtent(window.view(), window.endsInView());
    const bool isShort = window.rest().size() < kMark;
    if (extent.state == State::Foreign || (isShort && window.isAtEnd)) {
        skipTo(window, findMark(window.bytes, window.at + 1, window.isAtEnd));
        return true;
    }
    if (isShort) {
        return await(window, kMark);
    }
    pass(window, window.at, Kind::Skipped);
    switch (extent.state) {
    case State::Known:
        return stepDatagram(window, extent.size);
    case State::Unknown:
        return stepUnknownSize(window);
    default:
        return window.endsInView() ? stepCutOff(window) : await(window, window.rest().size() + 1);
    }
}

bool TcpFramer::stepDatagram(Window& window, std::size_t size) {
    const Bytes view = window.view();
    if (view.size() < size) {
        return window.isAtEnd ? stepCutOff(window) : await(window, size);
    }
    if (isTrusted(view.first(size))) {
        return deliver(window, size);
    }
    const Bytes after = view.subspan(size);
    if (after.size() < kMark && !window.endsInView()) {
        return await(window, size + kMark);
    }
    if (wire::startsDatagram(after) || after.empty()) {
        return deliver(window, size);
    }
    // Either the size is wrong or what follows is garbage. A datagram that begins inside decides for the
    // former.
    const std::size_t inner =
        findMark(view.first(std::min(view.size(), size + kMark - 1)), wire::kHeaderSize, true);
    if (inner < size || m_isInStep) {
        return deliver(window, std::min(inner, size));
    }
    skipTo(window, window.at + kMark);
    return true;
}

/// A header without a length ends where the next one begins.
bool TcpFramer::stepUnknownSize(Window& window) {
    const Bytes view = window.view();
    const std::size_t mark = findMark(view, wire::kHeaderSize, window.endsInView());
    const bool isFound = mark + kMark <= view.size();
    if (!isFound && !window.endsInView() && view.size() < kEnough) {
        return await(window, view.size() + 1);
    }
    if ((isFound || window.endsInView()) && mark <= wire::kMaxDatagramSize) {
        return deliver(window, mark);
    }
    skipTo(window, window.at + kMark);
    return true;
}

/// The stream ended inside a datagram, or the size in its header is wrong and swallows others.
bool TcpFramer::stepCutOff(Window& window) {
    return deliver(window, findMark(window.view(), wire::kHeaderSize, true));
}

/// Moves on over bytes that begin no datagram.
void TcpFramer::skipTo(Window& window, std::size_t position) {
    m_isInStep = false;
    window.at = position;
    while (window.at - window.begin >= kLongestSkip) {
        pass(window, window.begin + kLongestSkip, Kind::Skipped);
    }
}

bool TcpFramer::deliver(Window& window, std::size_t size) {
    m_isInStep = true;
    window.at += size;
    pass(window, window.at, Kind::Datagram);
    return true;
}

void TcpFramer::pass(Window& window, std::size_t end, Kind kind) {
    const std::size_t size = end - window.begin;
    if (size == 0) {
        return;
    }
    m_skippedBytes += kind == Kind::Skipped ? size : 0;
    window.visit({m_offset, window.bytes.subspan(window.begin, size), kind});
    m_offset += size;
    window.begin = end;
}

bool TcpFramer::await(const Window& window, std::size_t size) {
    m_need = window.at - window.begin + size;
    return false;
}

/// True if the datagram itself says that its size is right, so that nothing after it need be seen.
bool TcpFramer::isTrusted(Bytes datagram) {
    if (!wire::decodeInto(datagram, m_scratch)) {
        return false;
    }
    return std::ranges::none_of(m_scratch.notices, [this](const wire::Notice& notice) {
        using enum wire::NoticeCode;
        const bool isUnknown = notice.code == UnknownType || notice.code == UnknownLayout;
        // Nothing to check: then the place decides.
        return isUnknown ? !m_isInStep : notice.code == TrailingBytes || notice.code == SizeDisagrees;
    });
}

} // namespace posewire::log
