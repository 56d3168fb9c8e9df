// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/packet.h"
#include "core/log/time.h"

#include <cstddef>
#include <cstdint>
#include <optional>

namespace posewire::log {
class StreamEntries;
struct StreamKey;
} // namespace posewire::log

namespace posewire::model {

struct Choices;
class Ingest;

/// Readers of a session are made of a moment: what counts is what had been received by then. It is now, or
/// the operator's cursor, which it follows. Cheap to copy; the session outlives it.
class Moment {
public:
    Moment(Ingest& ingest, const Choices& choices, bool isNow)
        : m_ingest(&ingest), m_choices(&choices), m_isNow(isNow) {}

    [[nodiscard]] Ingest& ingest() const { return *m_ingest; }
    [[nodiscard]] const Choices& choices() const { return *m_choices; }
    [[nodiscard]] Moment now() const { return {*m_ingest, *m_choices, true}; }

    [[nodiscard]] bool isPaused() const;
    /// One past the newest packet that had been received.
    [[nodiscard]] std::uint64_t end() const;
    /// Nothing if the log has dropped it. The bytes are valid until the session follows the log again.
    [[nodiscard]] std::optional<log::Packet> packet(std::uint64_t number) const;
    /// All that were received of a stream, whatever the moment; null if none were.
    [[nodiscard]] const log::StreamEntries* entriesOf(const log::StreamKey& key) const;
    [[nodiscard]] std::size_t countOf(const log::StreamEntries& entries) const;
    /// Ages are measured against it: the stamp of the newest packet if it is in the past.
    [[nodiscard]] log::Stamp stamp() const;
    /// Nothing unless it is in the past.
    [[nodiscard]] std::optional<log::Stamp> pausedStamp() const;

private:
    Ingest* m_ingest;
    const Choices* m_choices;
    bool m_isNow;
};

} // namespace posewire::model
