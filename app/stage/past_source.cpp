// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/stage/past_source.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

namespace posewire::stage {

net::NetResult<std::unique_ptr<PastSource>> PastSource::open(const ServerChoice& servers,
                                                             const std::string& site, log::WallTime since,
                                                             log::WallTime until,
                                                             log::IsCancelled isCancelled) {
    auto server = Server::connect(servers, "posewire");
    if (!server) {
        return tl::unexpected(server.error());
    }
    const auto stream = (*server)->stream(site);
    if (!stream) {
        return tl::unexpected(stream.error());
    }
    std::unique_ptr<PastSource> source(new PastSource(std::move(*server), site));
    source->m_since = since;
    source->m_until = until;
    source->m_isCancelled = std::move(isCancelled);
    source->m_last = stream->last;
    return source;
}

tl::expected<std::size_t, log::FileError> PastSource::read(std::span<std::byte> into) {
    while (m_read == m_batch.bytes().size()) {
        m_batch.clear();
        m_read = 0;
        const auto fetched = fetch();
        if (!fetched) {
            return tl::unexpected(fetched.error());
        }
        if (!*fetched) {
            return std::size_t{0};
        }
    }
    const auto bytes = m_batch.bytes().subspan(m_read);
    const std::size_t size = std::min(bytes.size(), into.size());
    std::memcpy(into.data(), bytes.data(), size);
    m_read += size;
    return size;
}

tl::expected<bool, log::FileError> PastSource::fetch() {
    constexpr std::chrono::milliseconds kLook(100);
    constexpr int kMostTries = 50;
    constexpr log::Duration kLatest = std::chrono::minutes(5);
    for (int tries = 0; m_next <= m_last; ++tries) {
        if (m_isCancelled && m_isCancelled()) {
            return tl::unexpected(
                log::FileError{name() + ": reading was cancelled", log::FileError::Kind::Cancelled});
        }
        if (tries == kMostTries && !m_hasSome && m_server->isConnected()) {
            return false; // nothing was stored since then
        }
        if (tries == kMostTries) {
            return tl::unexpected(log::FileError{name() +
                                                     ": the servers did not answer for five seconds; all "
                                                     "before that was read",
                                                 log::FileError::Kind::Cut});
        }
        if (m_batches == nullptr) {
            auto begun = m_server->read(m_site, "posewire." + m_site + ".*.batch", m_next, m_since);
            m_batches = begun ? std::move(*begun) : nullptr;
        }
        const Message message = m_batches != nullptr ? Server::next(m_batches, kLook) : nullptr;
        if (message == nullptr) {
            continue;
        }
        tries = 0;
        m_hasSome = true;
        m_next = sequenceOf(message) + 1;
        if (storedAt(message) - kLatest > m_until) {
            return false;
        }
        m_order.take(message, [this](const log::FileRecord& record) {
            if (record.time && *record.time >= m_since && *record.time < m_until) {
                m_batch.add(
                    {0, log::asStamp(*record.time), {}, record.kernelDropsBefore, record.flags, record.bytes},
                    *record.sender);
            }
        });
        if (!m_batch.isEmpty()) {
            return true;
        }
    }
    return false;
}

} // namespace posewire::stage
